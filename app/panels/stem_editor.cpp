#include "app/panels/stem_editor.h"

#include <imgui.h>

#include <cmath>

#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/plant_drawing.h"
#include "app/plant_step.h"

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;

const PlantSnapshot* plant_of(const Ui& ui) {
  const int p = ui.selection.plant;
  return p >= 0 && p < static_cast<int>(ui.snapshot->plants.size())
             ? &ui.snapshot->plants[static_cast<std::size_t>(p)]
             : nullptr;
}

double length_of(const plant::PlantCurve& curve) {
  double length = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += (curve.points[i] - curve.points[i - 1]).norm();
  return length;
}

/// A labelled number with its unit; true when a new one was typed.
bool edit(const Ui& ui, const char* label, const char* unit, double& value) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(palette().dim, "%s", label);
  const float unit_width = ImGui::CalcTextSize(unit).x + 6.0f * ui.scale;
  ImGui::SameLine(0.42f * ImGui::GetContentRegionMax().x);
  ImGui::SetNextItemWidth(rest_width(*unit ? unit_width : 0.0f));
  ImGui::PushID(label);
  const bool typed = number_field("##number", value);
  ImGui::PopID();
  if (*unit) {
    ImGui::SameLine(0, 6.0f * ui.scale);
    ImGui::TextColored(palette().dim, "%s", unit);
  }
  return typed;
}

void stem_buttons(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  if (ImGui::Button("Smooth"))
    ui.run(Command("smooth points", {{"plant", plant}, {"stem", curve.name}}));
  tip("Moves points towards the middle of their neighbours");
  ImGui::SameLine();
  if (ImGui::Button("Mirror"))
    ui.run(Command("mirror stem", {{"plant", plant}, {"stem", curve.name}}));
  tip("Copies the stem with everything on it to the other side of its parent");
  ImGui::SameLine();
  if (ImGui::Button("Repeat"))
    ui.run(Command(
        "repeat stem",
        {{"plant", plant}, {"stem", curve.name}, {"count", 1}, {"spacing", 0.03}, {"angle", 2.4}}));
  tip("Copies it 30 mm further along its parent, turned by 2.4 rad");
  ImGui::SameLine();
  if (ImGui::Button("Delete")) {
    ui.run(Command("delete stem", {{"plant", plant}, {"stem", curve.name}}));
    ui.selection = {};
  }
}

void stem_numbers(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  double length = 1e3 * length_of(curve);
  if (edit(ui, "Length", "mm", length) && length > 0)
    ui.run(
        Command("set length", {{"plant", plant}, {"stem", curve.name}, {"length", 1e-3 * length}}));
  if (curve.radius.empty()) return;
  double foot = 1e3 * curve.radius.front(), top = 1e3 * curve.radius.back();
  const bool foot_typed = edit(ui, "Radius at foot", "mm", foot);
  const bool top_typed = edit(ui, "Radius at tip", "mm", top);
  if (foot_typed || top_typed)
    ui.run(Command(
        "taper",
        {{"plant", plant}, {"stem", curve.name}, {"from", 1e-3 * foot}, {"to", 1e-3 * top}}));
}

void point_row(Ui& ui, const std::string& plant, const plant::PlantCurve& curve, int index) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const bool chosen = ui.selection.kind == Kind::curve_point && ui.selection.point == index;
  ImGui::PushID(index);
  if (ImGui::Selectable(std::to_string(index).c_str(), chosen)) {
    ui.selection.kind = Kind::curve_point;
    ui.selection.point = index;
  }
  const auto place = static_cast<std::size_t>(index);
  Vec3 point = 1e3 * curve.points[place];
  for (int axis = 0; axis < 3; ++axis) {
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
    ImGui::PushID(axis);
    if (number_field("##p", point[axis], "%.1f"))
      ui.run(Command(
          "move point",
          {{"plant", plant}, {"stem", curve.name}, {"point", index}, {"to", Vec3(1e-3 * point)}}));
    ImGui::PopID();
  }
  ImGui::TableNextColumn();
  if (!curve.radius.empty()) {
    double radius = 1e3 * (curve.radius.size() == 1 ? curve.radius[0] : curve.radius[place]);
    ImGui::SetNextItemWidth(-1);
    if (number_field("##r", radius, "%.2f") && radius > 0)
      ui.run(Command(
          "set radius",
          {{"plant", plant}, {"stem", curve.name}, {"radius", 1e-3 * radius}, {"point", index}}));
  }
  ImGui::PopID();
}

void point_table(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  heading(ui, "Points, mm");
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(2 * ui.scale, 1 * ui.scale));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(3 * ui.scale, 2 * ui.scale));
  if (ImGui::BeginTable("points", 5, ImGuiTableFlags_SizingStretchProp)) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 16.0f * ui.scale);
    for (const char* name : {"x", "y", "z", "r"}) ImGui::TableSetupColumn(name);
    ImGui::TableHeadersRow();
    for (int i = 0; i < static_cast<int>(curve.points.size()); ++i) point_row(ui, plant, curve, i);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar(2);
}

void fruit_details(Ui& ui) {
  const PlantSnapshot* plant = plant_of(ui);
  if (!plant || ui.selection.fruit >= static_cast<int>(plant->model->fruits.size())) return;
  const auto index = static_cast<std::size_t>(ui.selection.fruit);
  const cosserat::Fruit& fruit = plant->model->fruits[index];
  if (index < plant->margin_used.size())
    row("Of its threshold", number_text(100.0 * plant->margin_used[index], 3) + " %");
  row("Mass", number_text(1e3 * fruit_mass(fruit), 3) + " g");
  const int p = ui.session.document().plant_index(plant->model->name);
  const plant::PlantFile* file =
      p >= 0 ? ui.session.document().plants[static_cast<std::size_t>(p)].file.get() : nullptr;
  if (!file) return;
  for (const plant::PlantFruit& one : file->fruits) {
    if (one.name != fruit.name) continue;
    const auto set = [&](const char* key, double value) {
      ui.run(Command(
          "set organ",
          {{"plant", plant->model->name}, {"name", one.name}, {"key", key}, {"value", value}}));
    };
    double radius = 1e3 * one.radius, density = one.density, at = one.place.at;
    double stretch = one.detach.stretch.value_or(0.0), force = one.detach.force.value_or(0.0);
    if (edit(ui, "Radius", "mm", radius)) set("radius", 1e-3 * radius);
    if (edit(ui, "Density", "kg/m3", density)) set("density", density);
    if (edit(ui, "Comes off at strain", "", stretch)) set("stretch", stretch);
    if (edit(ui, "or at a force of", "N", force)) set("force", force);
    if (edit(ui,
             "Place on "
             "stem",
             "", at))
      ui.run(Command("move organ", {{"plant", plant->model->name},
                                    {"name", one.name},
                                    {"stem", one.place.curve},
                                    {"at", at}}));
    tip("0 is the foot of " + one.place.curve + ", 1 its tip");
    if (wide_button("Delete fruit")) {
      ui.run(Command("delete organ", {{"plant", plant->model->name}, {"name", one.name}}));
      ui.selection = {};
      return;
    }
  }
}

void element_details(Ui& ui) {
  const PlantSnapshot* plant = plant_of(ui);
  const int e = ui.selection.element;
  if (!plant || e < 0 || e >= plant->model->size() || !plant->state.alive[e]) return;
  row("Strain here", number_text(surface_strain(*plant->model, plant->state, e), 3));
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
      if (fruit_name(model, f) != plant + "/" + fruit) continue;
      ui.selection = {};
      ui.selection.kind = Kind::fruit;
      ui.selection.plant = static_cast<int>(p);
      ui.selection.fruit = f;
      ui.selection.element = model.fruits[static_cast<std::size_t>(f)].element;
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
  if (ui.selection.kind == Kind::fruit) return fruit_details(ui);
  if (ui.selection.kind == Kind::link) return link_details(ui);
  if (ui.selection.kind == Kind::element) element_details(ui);
  std::string plant;
  const plant::PlantCurve* found = chosen_curve(ui, plant);
  if (!found) return;
  const plant::PlantCurve curve = *found;  // commands replace the document
  stem_numbers(ui, plant, curve);
  stem_buttons(ui, plant, curve);
  point_table(ui, plant, curve);
}

}  // namespace pedicel::app
