#include "app/editors/stem_editor.h"

#include <imgui.h>

#include "app/draw/plant_drawing.h"
#include "app/editors/copy_part.h"
#include "app/editors/organ_numbers.h"
#include "app/editors/point_editor.h"
#include "app/editors/thing_editor.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;

const PlantSnapshot* plant_of(const Ui& ui) {
  const int p = ui.selection.plant;
  return p >= 0 && p < static_cast<int>(ui.snapshot->plants.size())
             ? &ui.snapshot->plants[static_cast<std::size_t>(p)]
             : nullptr;
}

/// m, along the stem as it is interpolated.
double length_of(const plant::PlantCurve& curve) {
  plant::PlantFile alone;
  alone.curves = {curve};
  return plant::stem_curve(alone, curve.name).length();
}

void stem_numbers(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  double length = 1e3 * length_of(curve);
  if (labelled_number(ui, "Length", "mm", length) && length > 0)
    ui.run(
        Command("set length", {{"plant", plant}, {"stem", curve.name}, {"length", length / 1e3}}));
  if (curve.radius.empty()) return;
  double foot = 1e3 * curve.radius.front(), top = 1e3 * curve.radius.back();
  const bool foot_typed = labelled_number(ui, "Radius at foot", "mm", foot);
  const bool top_typed = labelled_number(ui, "Radius at tip", "mm", top);
  if (foot_typed || top_typed)
    ui.run(
        Command("taper",
                {{"plant", plant}, {"stem", curve.name}, {"from", foot / 1e3}, {"to", top / 1e3}}));
}

/// The robot takes it off.
void pick_button(Ui& ui, const std::string& organ) {
  if (!ui.snapshot->robot.present) return;
  if (wide_button("Take off with the robot") && ui.run(Command("pick", {{"organ", organ}})))
    ui.session.control().play();
  tip("Leads the tool to the fruit, shuts the gripper on it and pulls it up");
}

void fruit_details(Ui& ui) {
  const PlantSnapshot* plant = plant_of(ui);
  if (!plant || ui.selection.fruit >= static_cast<int>(plant->model->fruits.size())) return;
  const auto index = static_cast<std::size_t>(ui.selection.fruit);
  const cosserat::Fruit& fruit = plant->model->fruits[index];
  pick_button(ui, simulation::fruit_name(*plant->model, ui.selection.fruit));
  if (index < plant->margin_used.size())
    row("Of its threshold", number_text(100.0 * plant->margin_used[index], 3) + " %");
  row("Mass", number_text(1e3 * fruit_mass(fruit), 3) + " g");
  const int p = ui.session.document().plant_index(plant->model->name);
  const plant::PlantFile* file =
      p >= 0 ? ui.session.document().plants[static_cast<std::size_t>(p)].file.get() : nullptr;
  if (!file) return;
  for (const plant::PlantFruit& one : file->fruits) {
    if (one.name != fruit.name) continue;
    double at = one.place.at;
    draw_fruit_numbers(ui, plant->model->name, one);
    draw_thresholds(ui, plant->model->name, one);
    if (labelled_number(ui, "Place on stem", "", at))
      ui.run(Command("move organ", {{"plant", plant->model->name},
                                    {"name", one.name},
                                    {"stem", one.place.curve},
                                    {"at", at}}));
    tip("0 is the first point of " + one.place.curve + ", 1 its last; or drag it in the scene (D)");
    if (wide_button("Delete fruit")) {
      ui.remove(Command("delete organ", {{"plant", plant->model->name}, {"name", one.name}}));
      ui.selection = {};
      return;
    }
  }
}

/// The chosen leaf of the document; null where the selection is none.
const plant::PlantLeaf* chosen_leaf(const Ui& ui, std::string& plant) {
  if (ui.selection.kind != Kind::element) return nullptr;
  const std::string organ = describe(ui.selection, *ui.snapshot);
  const std::size_t slash = organ.find('/');
  if (slash == std::string::npos) return nullptr;
  plant = organ.substr(0, slash);
  const int p = ui.session.document().plant_index(plant);
  const auto* file =
      p < 0 ? nullptr : ui.session.document().plants[static_cast<std::size_t>(p)].file.get();
  if (!file) return nullptr;
  for (const plant::PlantLeaf& leaf : file->leaves)
    if (leaf.name == organ.substr(slash + 1)) return &leaf;
  return nullptr;
}

void leaf_details(Ui& ui, const std::string& plant, const plant::PlantLeaf& leaf) {
  double at = leaf.place.at;
  draw_leaf_numbers(ui, plant, leaf);
  if (labelled_number(ui, "Place on stem", "", at))
    ui.run(
        Command("move organ",
                {{"plant", plant}, {"name", leaf.name}, {"stem", leaf.place.curve}, {"at", at}}));
  tip("0 is the first point of " + leaf.place.curve + ", 1 its last; or drag it in the scene (D)");
  if (wide_button("Delete leaf")) ui.ask(Action::remove);
}

void element_details(Ui& ui) {
  const PlantSnapshot* plant = plant_of(ui);
  const int e = ui.selection.element;
  if (!plant || e < 0 || e >= plant->model->size() || !plant->state.alive[e]) return;
  row("Strain here", number_text(simulation::surface_strain(*plant->model, plant->state, e), 3));
  const cosserat::JointLoad load = joint_load(*plant->model, plant->state, e);
  row("Force in it", quantity_text(load.force.norm(), "N"));
  row("Moment in it", quantity_text(load.moment.norm(), "N m"));
}

void link_details(Ui& ui) {
  const auto& links = ui.snapshot->robot.links;
  const auto l = static_cast<std::size_t>(ui.selection.link);
  if (l >= links.size()) return;
  const Vec3 p = 1e3 * links[l].position;
  row("Place, mm",
      number_text(p.x(), 4) + ", " + number_text(p.y(), 4) + ", " + number_text(p.z(), 4));
}

}  // namespace

void choose_curve(Ui& ui, const std::string& plant, const std::string& curve) {
  ui.selection = {};
  ui.selection.kind = Kind::curve;
  ui.selection.plant_name = plant;
  ui.selection.curve = curve;
  ui.draw.plant = plant;
  ui.session.control().log().watch(plant + "/" + curve);
}

void choose_fruit(Ui& ui, const std::string& plant, const std::string& fruit) {
  for (std::size_t p = 0; p < ui.snapshot->plants.size(); ++p) {
    const cosserat::RodModel& model = *ui.snapshot->plants[p].model;
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      if (simulation::fruit_name(model, f) != plant + "/" + fruit) continue;
      ui.selection = {};
      ui.selection.kind = Kind::fruit;
      ui.selection.plant = static_cast<int>(p);
      ui.selection.fruit = f;
      ui.selection.element = model.fruits[static_cast<std::size_t>(f)].element;
      ui.selection.back = model.fruits[static_cast<std::size_t>(f)].back;
    }
  }
}

void choose_leaf(Ui& ui, const std::string& plant, const std::string& leaf) {
  for (std::size_t p = 0; p < ui.snapshot->plants.size(); ++p) {
    const cosserat::RodModel& model = *ui.snapshot->plants[p].model;
    for (int e = 0; e < model.size(); ++e) {
      const auto organ =
          static_cast<std::size_t>(model.elements[static_cast<std::size_t>(e)].organ);
      if (model.organs[organ] != plant + "/" + leaf) continue;
      ui.selection = {};
      ui.selection.kind = Kind::element;
      ui.selection.plant = static_cast<int>(p);
      ui.selection.element = e;
      return;
    }
  }
}

const plant::PlantCurve* chosen_curve(const Ui& ui, std::string& plant) {
  std::string curve = ui.selection.curve;
  plant = ui.selection.plant_name;
  if (ui.selection.kind == Kind::element) {
    const std::string organ = describe(ui.selection, *ui.snapshot);
    const std::size_t slash = organ.find('/');
    if (slash == std::string::npos) return nullptr;
    plant = organ.substr(0, slash);
    curve = organ.substr(slash + 1);
  }
  const int p = ui.session.document().plant_index(plant);
  if (p < 0) return nullptr;
  const auto& file = ui.session.document().plants[static_cast<std::size_t>(p)].file;
  const int c = file ? file->curve_index(curve) : -1;
  return c >= 0 ? &file->curves[static_cast<std::size_t>(c)] : nullptr;
}

void draw_details(Ui& ui) {
  ImGui::PushFont(ui.bold);
  elided(describe(ui.selection, *ui.snapshot), rest_width(), &palette().warning);
  ImGui::PopFont();
  draw_place(ui);
  if (ui.selection.kind == Kind::fruit) return fruit_details(ui);
  if (ui.selection.kind == Kind::link) link_details(ui);
  if (draw_thing(ui)) return;
  if (ui.selection.kind == Kind::element) element_details(ui);
  std::string plant;
  if (const plant::PlantLeaf* found = chosen_leaf(ui, plant)) {
    const plant::PlantLeaf leaf = *found;  // commands replace the document
    return leaf_details(ui, plant, leaf);
  }
  const plant::PlantCurve* found = chosen_curve(ui, plant);
  if (!found) return;
  const plant::PlantCurve curve = *found;
  if (ui.selection.to_tip) {
    note("From here to the tip, with all that is on it");
    if (wide_button("Cut it off")) ui.ask(Action::remove);
    tip("(" + keys_of(Action::remove) + ")");
  }
  stem_numbers(ui, plant, curve);
  draw_points(ui, plant, curve);
  draw_stem_material(ui, plant, curve);
  draw_stem_loads(ui, plant, curve);
  draw_copies(ui, plant, curve.name);
  if (ui.selection.to_tip) return;
  heading(ui, "Stem");
  if (wide_button("Delete stem")) {
    if (ui.remove(Command("delete stem", {{"plant", plant}, {"stem", curve.name}})))
      ui.selection = {};
  }
  tip("With its branches and all that is on them");
}

}  // namespace pedicel::app
