#include "pedicel/app/editors/organ_numbers.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "pedicel/app/session/document/effective_plant.h"
#include "pedicel/app/ui/selection_follow.h"
#include "pedicel/app/ui/theme.h"
#include "pedicel/app/ui/widgets.h"
#include "pedicel/io/csv.h"

namespace pedicel::app {

namespace {

using plant::DetachLimits;
using plant::MaterialValues;

struct Threshold {
  const char *key, *label, *unit;
  std::optional<double> DetachLimits::*limit;
};
constexpr std::array<Threshold, 5> thresholds = {
    {{"stretch", "Off at strain of", "", &DetachLimits::stretch},
     {"bend", "or bent by", "rad", &DetachLimits::bend},
     {"force", "or at a force of", "N", &DetachLimits::force},
     {"moment", "or a moment of", "N m", &DetachLimits::moment},
     {"torsion", "or a torsion of", "N m", &DetachLimits::torsion}}};

struct Constant {
  const char *key, *label, *unit, *what;
  std::optional<double> MaterialValues::*value;
};
constexpr std::array<Constant, 4> constants = {
    {{"youngs_modulus", "Modulus", "Pa", "Stiffness of this stem", &MaterialValues::youngs_modulus},
     {"density", "Density", "kg/m3", "Mass of this stem", &MaterialValues::density},
     {"damping_time", "Damping", "s", "Kelvin-Voigt time of this stem",
      &MaterialValues::damping_time},
     {"poisson_ratio", "Poisson ratio", "", "Shear and twist of this stem",
      &MaterialValues::poisson_ratio}}};

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
  for (const Threshold& one : thresholds) {
    const std::string key = std::string("detach.") + one.key;
    const PlantSetting set = who_sets(ui.session.document(), plant, key);
    double value = (now->detach.*one.limit).value_or(0.0);
    if (labelled_number(ui, one.label, one.unit, value) && value >= 0.0)
      set_over(
          ui, plant, key, set, value,
          Command("set organ",
                  {{"plant", plant}, {"name", fruit.name}, {"key", one.key}, {"value", value}}));
    tip("0: never for this cause. Enter takes it over");
    say_who(set, text_of(fruit.detach.*one.limit));
  }
}

void draw_stem_material(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  heading(ui, "Material");
  const Document& document = ui.session.document();
  const plant::PlantFile acting = effective_plant(document, plant);
  const int index = acting.curve_index(curve.name);
  if (index < 0) return;
  const MaterialValues& own = acting.curves[static_cast<std::size_t>(index)].material;
  bool any_own = false;
  for (const Constant& one : constants) {
    const std::optional<double> of_plant = acting.material.*one.value;
    double value = (own.*one.value).value_or(of_plant.value_or(0.0));
    const std::string key = std::string("material.") + one.key;
    if (labelled_number(ui, one.label, one.unit, value))
      set_over(
          ui, plant, key, who_sets(document, plant, key), value,
          Command("set material",
                  {{"plant", plant}, {"key", one.key}, {"value", value}, {"stem", curve.name}}));
    const bool is_own = (curve.material.*one.value).has_value();
    any_own = any_own || is_own;
    tip(std::string(one.what) + (is_own ? ", its own" : ", the plant's until another is typed"));
  }
  if (!any_own) return note("The plant's; what is typed is this stem's own.");
  if (!wide_button("As the plant")) return;
  ui.session.begin_gesture();
  for (const Constant& one : constants)
    if (curve.material.*one.value)
      ui.run(Command("set material",
                     {{"plant", plant}, {"key", one.key}, {"value", 0.0}, {"stem", curve.name}}));
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
