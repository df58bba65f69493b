#include "app/editors/point_editor.h"

#include <imgui.h>

#include <array>

#include "app/editors/stem_editor.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"
#include "plugins/plant/plant_edit.h"

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;
using plant::PointKind;

constexpr std::array<const char*, 3> kind_names = {"smooth", "corner", "linear"};
constexpr std::array<const char*, 3> kind_labels = {"Smooth", "Corner", "Linear"};
constexpr std::array<const char*, 3> kind_tips = {
    "The stem passes without a bend",
    "The stem bends here: two more points close by hold it, since plant files know no corners. "
    "Between ends or other corners that is the same as Linear",
    "The stem bends here and is straight to both neighbours"};

/// The chosen stem and point; -1: none is chosen.
struct Chosen {
  std::string plant;
  plant::PlantCurve curve;
  int point = -1;
};
std::optional<Chosen> chosen(const Ui& ui) {
  Chosen one;
  const plant::PlantCurve* curve = chosen_curve(ui, one.plant);
  if (!curve) return {};
  one.curve = *curve;  // commands replace the document
  const int count = static_cast<int>(curve->points.size());
  // What was undone may have had more points.
  if (ui.selection.kind == Kind::curve_point && ui.selection.point < count)
    one.point = ui.selection.point;
  return one;
}

std::optional<Chosen> chosen_point(Ui& ui) {
  auto one = chosen(ui);
  if (one && one->point >= 0) return one;
  ui.say("Choose a control point first: D, a click on the stem, a click on a white ball");
  return {};
}

/// The chosen point may have another number now.
void choose_place(Ui& ui, const Chosen& one, const Vec3& place) {
  const int p = ui.session.document().plant_index(one.plant);
  const plant::PlantFile* file =
      p < 0 ? nullptr : ui.session.document().plants[static_cast<std::size_t>(p)].file.get();
  const int c = file ? file->curve_index(one.curve.name) : -1;
  if (c < 0) return;
  const auto& points = file->curves[static_cast<std::size_t>(c)].points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((points[i] - place).norm() > 1e-9) continue;
    choose_curve(ui, one.plant, one.curve.name);
    ui.selection.kind = Kind::curve_point;
    ui.selection.point = static_cast<int>(i);
    return;
  }
}

geometry::Curve curve_of(const plant::PlantCurve& curve) {
  plant::PlantFile alone;
  alone.curves = {curve};
  return plant::stem_curve(alone, curve.name);
}

/// The middle of the piece behind a point, or of the longest one, as a fraction of the length.
double middle_of_piece(const plant::PlantCurve& curve, int point) {
  const geometry::Curve drawn = curve_of(curve);
  const auto all = plant::control_points(curve);
  double best = -1.0, place = 0.5;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double from = drawn.control_arc(all[i - 1].index), to = drawn.control_arc(all[i].index);
    const bool wanted = all[i - 1].index == point || (i + 1 == all.size() && all[i].index == point);
    const double merit = wanted ? 2.0 * drawn.length() : to - from;
    if (merit > best) best = merit, place = 0.5 * (from + to) / drawn.length();
  }
  return place;
}

void kind_buttons(Ui& ui, const plant::PlantCurve& curve) {
  const bool is_chosen = ui.selection.kind == Kind::curve_point;
  const PointKind now =
      is_chosen ? plant::point_kind(curve, ui.selection.point) : PointKind::smooth;
  ImGui::BeginDisabled(!is_chosen);
  for (std::size_t k = 0; k < kind_names.size(); ++k) {
    if (k) ImGui::SameLine(0, 10.0f * ui.scale);
    const auto kind = static_cast<PointKind>(k);
    if (ImGui::RadioButton(kind_labels[k], is_chosen && now == kind)) set_point_kind(ui, kind);
    tip(kind_tips[k] + std::string(" (") + keys_of(Action::point_kind) + ")");
  }
  ImGui::EndDisabled();
}

void point_buttons(Ui& ui) {
  const bool is_chosen = ui.selection.kind == Kind::curve_point;
  const auto button = [&](const char* label, Action action, bool usable) {
    ImGui::BeginDisabled(!usable);
    if (ImGui::Button(label)) ui.ask(action);
    ImGui::EndDisabled();
    tip(sentence_of(action) + " (" + keys_of(action) + ")");
  };
  button("Insert", Action::insert_point, true);
  ImGui::SameLine();
  button("Smooth", Action::smooth, true);
  ImGui::SameLine();
  button("Delete", Action::remove, is_chosen);
}

void point_row(Ui& ui, const std::string& plant, const plant::PlantCurve& curve, int index) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const bool chosen = ui.selection.kind == Kind::curve_point && ui.selection.point == index;
  ImGui::PushID(index);
  if (ImGui::Selectable(std::to_string(index).c_str(), chosen)) {
    choose_curve(ui, plant, curve.name);
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
          {{"plant", plant}, {"stem", curve.name}, {"point", index}, {"to", Vec3(point / 1e3)}}));
    ImGui::PopID();
  }
  ImGui::TableNextColumn();
  if (!curve.radius.empty()) {
    double radius = 1e3 * (curve.radius.size() == 1 ? curve.radius[0] : curve.radius[place]);
    ImGui::SetNextItemWidth(-1);
    if (number_field("##r", radius, "%.2f") && radius > 0)
      ui.run(Command(
          "set radius",
          {{"plant", plant}, {"stem", curve.name}, {"radius", radius / 1e3}, {"point", index}}));
  }
  ImGui::PopID();
}

}  // namespace

void draw_points(Ui& ui, const std::string& plant, const plant::PlantCurve& curve) {
  heading(ui, "Points, mm");
  if (!ui.draw.on) note("Press " + keys_of(Action::draw_mode) + " to see and drag them.");
  kind_buttons(ui, curve);
  point_buttons(ui);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(2 * ui.scale, 1 * ui.scale));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(3 * ui.scale, 2 * ui.scale));
  if (ImGui::BeginTable("points", 5, ImGuiTableFlags_SizingStretchProp)) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 18.0f * ui.scale);
    for (const char* name : {"x", "y", "z", "r"}) ImGui::TableSetupColumn(name);
    ImGui::TableHeadersRow();
    for (const plant::ControlPoint& one : plant::control_points(curve))
      point_row(ui, plant, curve, one.index);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar(2);
}

void set_point_kind(Ui& ui, PointKind kind) {
  const auto one = chosen_point(ui);
  if (!one) return;
  const Vec3 place = one->curve.points[static_cast<std::size_t>(one->point)];
  if (!ui.run(Command("set point kind", {{"plant", one->plant},
                                         {"stem", one->curve.name},
                                         {"point", one->point},
                                         {"kind", kind_names[static_cast<std::size_t>(kind)]}})))
    return;
  choose_place(ui, *one, place);
  const auto now = chosen(ui);
  if (kind == PointKind::corner && now && now->point >= 0 &&
      plant::point_kind(now->curve, now->point) == PointKind::linear)
    ui.say("Linear: its neighbours are ends or corners, so the pieces beside it are straight");
}

void change_point_kind(Ui& ui) {
  const auto one = chosen_point(ui);
  if (!one) return;
  const int last = static_cast<int>(one->curve.points.size()) - 1;
  const auto kind = plant::point_kind(one->curve, one->point);
  auto next = static_cast<PointKind>((static_cast<int>(kind) + 1) % 3);
  if (next == PointKind::corner && (one->point == 0 || one->point == last))
    next = PointKind::linear;  // an end has no corner
  set_point_kind(ui, next);
}

void insert_point(Ui& ui) {
  const auto one = chosen(ui);
  if (!one) return ui.say("Choose a stem or a control point first");
  const double at = middle_of_piece(one->curve, one->point);
  const geometry::Curve drawn = curve_of(one->curve);
  if (ui.run(
          Command("insert point", {{"plant", one->plant}, {"stem", one->curve.name}, {"at", at}})))
    choose_place(ui, *one, drawn.point(at * drawn.length()));
}

void smooth_points(Ui& ui) {
  const auto one = chosen(ui);
  if (!one) return ui.say("Choose a stem or a control point first");
  if (one->point >= 0)
    ui.run(Command("smooth points", {{"plant", one->plant},
                                     {"stem", one->curve.name},
                                     {"first", one->point},
                                     {"last", one->point}}));
  else
    ui.run(Command("smooth points", {{"plant", one->plant}, {"stem", one->curve.name}}));
}

}  // namespace pedicel::app
