#include "app/panels/effects_part.h"

#include <imgui.h>

#include <map>

#include "app/panels/widgets.h"
#include "plant/effects.h"
#include "session/measured_commands.h"

namespace pedicel::app {

namespace {

using plant::Effect;
using plant::EffectKind;
using plant::EffectParameter;

/// Numbers to begin with: a light breeze, a tenth softer, a soft socket.
double first_number(const std::string& effect, const std::string& parameter) {
  static const std::map<std::string, double> by_effect = {{"weak_segment/factor", 0.5},
                                                          {"youngs_modulus/factor", 0.9},
                                                          {"gust/frequency", 0.5},
                                                          {"detachment_law/force", 5.0},
                                                          {"internal_friction/curvature", 1.0}};
  static const std::map<std::string, double> by_name = {
      {"factor", 1.0},    {"mass", 0.01},     {"stiffness", 5.0},  {"length", 0.02},
      {"k0", 10.0},       {"ratio", 0.5},     {"rate", 0.5},       {"loss_factor", 0.05},
      {"fraction", 0.2},  {"time", 10.0},     {"curvature", 10.0}, {"drag_area", 0.005},
      {"amplitude", 0.3}, {"frequency", 1.0}, {"gradient", 0.0},   {"coefficient", 0.0},
      {"moment", 0.01},   {"torsion", 0.01},  {"force", 5.0}};
  if (const auto own = by_effect.find(effect + "/" + parameter); own != by_effect.end())
    return own->second;
  const auto found = by_name.find(parameter);
  return found == by_name.end() ? 0.0 : found->second;
}

/// Those that a reader asks for, and one of each choice.
bool begins_with(const EffectKind& kind, const EffectParameter& parameter) {
  if (parameter.required) return true;
  return (kind.name == "internal_friction" && parameter.name == "curvature") ||
         (kind.name == "detachment_law" && parameter.name == "force");
}

Effect fresh(const EffectKind& kind, const plant::PlantFile& plant) {
  Effect effect;
  effect.name = kind.name;
  for (const EffectParameter& one : kind.parameters) {
    if (!begins_with(kind, one)) continue;
    if (one.size == 3)
      effect.numbers[one.name] = {one.name == "velocity" ? 2.0 : 0.0, 0.0,
                                  one.name == "velocity" ? 0.0 : 1.0};
    else if (one.size == 1)
      effect.numbers[one.name] = {first_number(kind.name, one.name)};
    else if (!one.words.empty())
      effect.words[one.name] = one.words.front();
  }
  if (kind.needs_place && !plant.curves.empty())
    effect.place = plant::CurvePlace{plant.curves.front().name, 0.5, {}};
  return effect;
}

std::string unit_of(const std::string& parameter) {
  static const std::map<std::string, std::string> units = {
      {"mass", "kg"},       {"stiffness", "N m/rad"},
      {"length", "m"},      {"rate", "1/s"},
      {"frequency", "Hz"},  {"time", "s"},
      {"curvature", "1/m"}, {"drag_area", "m2/m"},
      {"moment", "N m"},    {"torsion", "N m"},
      {"force", "N"}};
  const auto found = units.find(parameter);
  return found == units.end() ? "" : found->second;
}

bool numbers(const Ui& ui, const std::string& name, std::vector<double>& values) {
  if (values.size() == 1)
    return labelled_number(ui, name.c_str(), unit_of(name).c_str(), values[0]);
  bool typed = false;
  constexpr const char* axes[] = {" x", " y", " z"};
  for (std::size_t i = 0; i < values.size() && i < 3; ++i)
    typed =
        labelled_number(ui, (name + axes[i]).c_str(), name == "velocity" ? "m/s" : "", values[i]) ||
        typed;
  return typed;
}

bool words(const EffectKind& kind, const std::string& name, std::string& word) {
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
  const EffectKind* kind = plant::find_effect(effect.name);
  bool changed = false;
  for (auto& [name, values] : effect.numbers) changed = numbers(ui, name, values) || changed;
  for (auto& [name, word] : effect.words) changed = (kind && words(*kind, name, word)) || changed;
  if (effect.place) changed = place(ui, plant, *effect.place) || changed;
  return changed;
}

bool add(const plant::PlantFile& plant, std::vector<Effect>& effects) {
  bool added = false;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##add", "Add an effect")) return false;
  for (const EffectKind& kind : plant::known_effects()) {
    if (kind.home != plant::EffectHome::plant || !kind.simulated) continue;
    std::string label = kind.name;
    for (char& c : label)
      if (c == '_') c = ' ';
    if (!ImGui::Selectable(label.c_str())) continue;
    effects.push_back(fresh(kind, plant));
    added = true;
  }
  ImGui::EndCombo();
  return added;
}

}  // namespace

void draw_effects(Ui& ui, const std::string& plant) {
  const plant::PlantFile file = ui.session.document().plant(plant);  // commands replace it
  std::vector<Effect> effects = file.effects;
  bool changed = false;
  const float cross = 1.25f * ImGui::GetFrameHeight();
  for (std::size_t i = 0; i < file.effects.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(file.effects[i].name.c_str());
    ImGui::SameLine(ImGui::GetContentRegionMax().x - cross);
    const bool away = icon_button("delete", Icon::cross, "Takes it away");
    if (away)
      effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(i));
    else if (i < effects.size())
      changed = edit(ui, file, effects[i]) || changed;
    changed = changed || away;
    ImGui::PopID();
    if (away) break;
  }
  changed = add(file, effects) || changed;
  tip("Wind, a soft base, yield: what acts on the plant beside gravity, and what a stem is beyond "
      "an elastic rod");
  if (changed) ui.run(Command("set effects", {{"plant", plant}, {"text", effects_text(effects)}}));
}

}  // namespace pedicel::app
