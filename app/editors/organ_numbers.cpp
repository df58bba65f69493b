#include "app/editors/organ_numbers.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "app/session/document/effective_plant.h"
#include "app/ui/selection_follow.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"
#include "engine/io/csv.h"

namespace pedicel::app {

namespace {

using plant::MaterialKey;
using plant::MaterialValues;
using plant::PlantKey;

/// As the window writes a unit: none for pure numbers.
std::string unit_of(std::string_view unit) {
  return unit == "1" ? "" : std::string(unit);
}

/// The field of a number that has a label; lengths are in mm. True once one was typed.
template <typename Owner>
bool field(Ui& ui, const PlantKey<Owner>& key, double& value) {
  const double factor = key.unit == "m" ? 1e3 : 1.0;
  double shown = factor * value;
  const std::string unit = key.unit == "m" ? "mm" : unit_of(key.unit);
  const bool typed = labelled_number(ui, std::string(key.label).c_str(), unit.c_str(), shown);
  value = shown / factor;
  return typed;
}

/// Of a fruit or a leaf: `organ` is a copy, as each command replaces the plant.
template <typename Organ, typename Keys>
void draw_numbers(Ui& ui, const std::string& plant, const Keys& keys, const Organ& organ) {
  for (const PlantKey<Organ>& key : keys) {
    if (key.label.empty() || !key.is_number()) continue;
    double value = number_of(organ, key).value_or(0.0);
    if (field(ui, key, value))
      ui.run(Command("set organ", {{"plant", plant},
                                   {"name", organ.name},
                                   {"key", std::string(key.name)},
                                   {"value", value}}));
    if (!key.tip.empty()) tip(std::string(key.tip));
  }
}

void say_who(const PlantSetting& set, const std::string& file_says) {
  if (set.by == SetBy::session) note("tuned for the whole plant; its file says " + file_says);
  if (set.by == SetBy::scene) note("set by the scene for the whole plant");
}

/// A number of one organ where a setting of the whole plant hides the file's.
void set_over(Ui& ui, const std::string& plant, const std::string& key, const PlantSetting& set,
              double value, const Command& command) {
  if (set.by == SetBy::scene) {
    if (ui.run(Command(
            "set", {{"key", "plants." + plant + "." + key}, {"value", io::format_number(value)}})))
      ui.say("set for the whole plant, as the scene sets " + key);
    return;
  }
  ui.session.begin_gesture();
  const bool kept = set.by == SetBy::file || ui.run(Command("keep setting", {{"key", set.key}}));
  if (kept && ui.run(command))
    ui.session.end_gesture();
  else
    ui.session.cancel_gesture();
}

const plant::PlantFruit* fruit_of(const plant::PlantFile& plant, const std::string& name) {
  for (const plant::PlantFruit& one : plant.fruits)
    if (one.name == name) return &one;
  return nullptr;
}

std::string text_of(const std::optional<double>& value) {
  return value ? number_text(*value, 4) : "none";
}

}  // namespace

void draw_place(Ui& ui) {
  const auto place = place_of(ui.selection, *ui.snapshot);
  if (!place) return;
  std::array<char, 64> text{};
  const Vec3 mm = 1e3 * *place;
  std::snprintf(text.data(), text.size(), "%.1f, %.1f, %.1f", mm.x(), mm.y(), mm.z());
  row("In the world, mm", text.data());
  if (ui.snapshot->robot.present && ui.selection.kind != Selection::Kind::link)
    tool_to_selection_button(ui);
}

void tool_to_selection_button(Ui& ui) {
  const auto place = place_of(ui.selection, *ui.snapshot);
  ImGui::BeginDisabled(!place.has_value());
  if (ImGui::Button("Tool to selection")) {
    const Result result = ui.session.run(Command("tool", {{"to", *place}, {"near", 1}}));
    ui.say(!result.ok || !result.text.empty() ? result.text : "the tool goes there");
  }
  ImGui::EndDisabled();
  tip("Leads the robot's tool to the place of what is chosen, or as near as it can come");
}

void draw_thresholds(Ui& ui, const std::string& plant, const plant::PlantFruit& fruit) {
  const plant::PlantFile acting = effective_plant(ui.session.document(), plant);
  const plant::PlantFruit* now = fruit_of(acting, fruit.name);
  if (!now) return;
  for (const PlantKey<plant::DetachLimits>& one : plant::detach_keys) {
    const std::string name(one.name), key = "detach." + name;
    const PlantSetting set = who_sets(ui.session.document(), plant, key);
    double value = number_of(now->detach, one).value_or(0.0);
    if (field(ui, one, value) && value >= 0.0)
      set_over(ui, plant, key, set, value,
               Command("set organ",
                       {{"plant", plant}, {"name", fruit.name}, {"key", name}, {"value", value}}));
    tip("0: never for this cause. Enter takes it over");
    say_who(set, text_of(number_of(fruit.detach, one)));
  }
}

void draw_fruit_numbers(Ui& ui, const std::string& plant, const plant::PlantFruit& fruit) {
  draw_numbers(ui, plant, plant::fruit_keys, plant::PlantFruit(fruit));
}

void draw_leaf_numbers(Ui& ui, const std::string& plant, const plant::PlantLeaf& leaf) {
  draw_numbers(ui, plant, plant::leaf_keys, plant::PlantLeaf(leaf));
}

void draw_stem_material(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  heading(ui, "Material");
  const Document& document = ui.session.document();
  const plant::PlantFile acting = effective_plant(document, plant);
  const int index = acting.curve_index(curve.name);
  if (index < 0) return;
  const MaterialValues& own = acting.curves[static_cast<std::size_t>(index)].material;
  bool any_own = false;
  for (const MaterialKey& one : plant::material_keys) {
    const std::optional<double> of_plant = number_of(acting.material, one);
    double value = number_of(own, one).value_or(of_plant.value_or(0.0));
    const std::string name(one.name), key = "material." + name;
    if (field<MaterialValues>(ui, one, value))
      set_over(ui, plant, key, who_sets(document, plant, key), value,
               Command("set material",
                       {{"plant", plant}, {"key", name}, {"value", value}, {"stem", curve.name}}));
    const bool is_own = number_of(curve.material, one).has_value();
    any_own = any_own || is_own;
    tip(std::string(one.tip) + (is_own ? ", its own" : ", the plant's until another is typed"));
  }
  if (!any_own) return note("The plant's; what is typed is this stem's own.");
  if (!wide_button("As the plant")) return;
  ui.session.begin_gesture();
  for (const MaterialKey& one : plant::material_keys)
    if (number_of(curve.material, one))
      ui.run(Command("set material", {{"plant", plant},
                                      {"key", std::string(one.name)},
                                      {"value", 0.0},
                                      {"stem", curve.name}}));
  ui.session.end_gesture();
}

void draw_stem_loads(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  heading(ui, "Masses and clamps");
  const plant::PlantFile file = ui.session.document().plant(plant);  // commands replace it
  const float cross = 1.25f * ImGui::GetFrameHeight();
  const auto take_away = [&](const char* verb, std::size_t index) {
    ImGui::SameLine(ImGui::GetContentRegionMax().x - cross);
    if (icon_button("delete", Icon::cross, "Takes it away"))
      ui.run(Command(verb, {{"plant", plant}, {"index", static_cast<int>(index)}}));
  };
  for (std::size_t m = 0; m < file.masses.size(); ++m) {
    if (file.masses[m].place.curve != curve.name) continue;
    ImGui::PushID(static_cast<int>(m));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted((number_text(1e3 * file.masses[m].mass, 4) + " g at " +
                            number_text(file.masses[m].place.at, 3))
                               .c_str());
    take_away("delete mass", m);
    ImGui::PopID();
  }
  for (std::size_t s = 0; s < file.supports.size(); ++s) {
    if (file.supports[s].curve != curve.name) continue;
    ImGui::PushID(1000 + static_cast<int>(s));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(("clamp at " + number_text(file.supports[s].at, 3)).c_str());
    take_away("delete support", s);
    ImGui::PopID();
  }
  static double place = 1.0, grams = 10.0;
  labelled_number(ui, "Place on stem", "", place);
  tip("0 is its first point, 1 its last");
  labelled_number(ui, "Mass", "g", grams);
  if (ImGui::Button("Add mass"))
    ui.run(
        Command("add mass",
                {{"plant", plant}, {"stem", curve.name}, {"at", place}, {"mass", 1e-3 * grams}}));
  tip("Fixes a weight or a sensor to the stem at that place");
  ImGui::SameLine();
  if (ImGui::Button("Add clamp"))
    ui.run(Command("add support", {{"plant", plant}, {"stem", curve.name}, {"at", place}}));
  tip("Holds the stem at that place: a stake, a clip, a tie to a wire");
}

}  // namespace pedicel::app
