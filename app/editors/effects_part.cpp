#include "app/editors/effects_part.h"

#include <imgui.h>

#include "app/session/commands/measured_commands.h"
#include "app/ui/widgets.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::app {

namespace {

using effects::EffectDefinition;
using effects::EffectParameter;
using plant::Effect;

Effect fresh(const EffectDefinition& kind, const plant::PlantFile& plant) {
  Effect effect;
  effect.name = kind.name;
  for (const EffectParameter& one : kind.parameters) {
    if (!one.required && !one.offered) continue;
    if (one.size > 0)
      effect.numbers[one.name] = one.first;
    else if (!one.words.empty())
      effect.words[one.name] = one.words.front();
  }
  if (kind.needs_place && !plant.curves.empty())
    effect.place = plant::CurvePlace{plant.curves.front().name, 0.5, {}};
  return effect;
}

bool numbers(const Ui& ui, const std::string& effect, const std::string& name,
             std::vector<double>& values) {
  std::string unit = effects::unit_of(effect, name);
  if (unit == "1") unit.clear();
  if (values.size() == 1) return labelled_number(ui, name.c_str(), unit.c_str(), values[0]);
  bool typed = false;
  constexpr const char* axes[] = {" x", " y", " z"};
  for (std::size_t i = 0; i < values.size() && i < 3; ++i)
    typed = labelled_number(ui, (name + axes[i]).c_str(), unit.c_str(), values[i]) || typed;
  return typed;
}

bool words(const EffectDefinition& kind, const std::string& name, std::string& word) {
  for (const EffectParameter& one : kind.parameters) {
    if (one.name != name || one.words.empty()) continue;
    bool changed = false;
    for (const std::string& choice : one.words) {
      if (&choice != &one.words.front()) ImGui::SameLine();
      if (ImGui::RadioButton(choice.c_str(), word == choice)) word = choice, changed = true;
    }
    return changed;
  }
  return false;
}

bool place(const Ui& ui, const plant::PlantFile& plant, plant::CurvePlace& where) {
  bool changed = false;
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##stem", where.curve.c_str())) {
    for (const plant::PlantCurve& curve : plant.curves)
      if (ImGui::Selectable(curve.name.c_str(), curve.name == where.curve))
        where.curve = curve.name, changed = true;
    ImGui::EndCombo();
  }
  return labelled_number(ui, "Place on stem", "", where.at) || changed;
}

/// Whether it was changed.
bool edit(const Ui& ui, const plant::PlantFile& plant, Effect& effect) {
  const EffectDefinition* kind = effects::find_effect(effect.name);
  bool changed = false;
  for (auto& [name, values] : effect.numbers)
    changed = numbers(ui, effect.name, name, values) || changed;
  for (auto& [name, word] : effect.words) changed = (kind && words(*kind, name, word)) || changed;
  if (effect.place) changed = place(ui, plant, *effect.place) || changed;
  return changed;
}

bool add(const plant::PlantFile& plant, std::vector<Effect>& all) {
  bool added = false;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##add", "Add an effect")) return false;
  for (const EffectDefinition& kind : effects::effect_definitions()) {
    if (kind.file != effects::EffectFile::plant) continue;
    std::string label = kind.name;
    for (char& c : label)
      if (c == '_') c = ' ';
    if (!ImGui::Selectable(label.c_str())) continue;
    all.push_back(fresh(kind, plant));
    added = true;
  }
  ImGui::EndCombo();
  return added;
}

}  // namespace

void draw_effects(Ui& ui, const std::string& plant) {
  const plant::PlantFile file = ui.session.document().plant(plant);  // commands replace it
  std::vector<Effect> all = file.effects;
  bool changed = false;
  const float cross = 1.25f * ImGui::GetFrameHeight();
  for (std::size_t i = 0; i < file.effects.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(file.effects[i].name.c_str());
    ImGui::SameLine(ImGui::GetContentRegionMax().x - cross);
    const bool away = icon_button("delete", Icon::cross, "Takes it away");
    if (away)
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
    else if (i < all.size())
      changed = edit(ui, file, all[i]) || changed;
    changed = changed || away;
    ImGui::PopID();
    if (away) break;
  }
  changed = add(file, all) || changed;
  tip("Wind, a soft base, yield: what acts on the plant beside gravity, and what a stem is beyond "
      "an elastic rod");
  if (changed) ui.run(Command("set effects", {{"plant", plant}, {"text", effects_text(all)}}));
}

}  // namespace pedicel::app
