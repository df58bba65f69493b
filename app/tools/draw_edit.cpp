#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "pedicel/app/editors/stem_editor.h"
#include "pedicel/app/session/live/organ_place.h"
#include "pedicel/app/tools/draw_tool.h"
#include "pedicel/app/view/picking.h"
#include "pedicel/plant/point_kind.h"

/// What is dragged: control points, radii, fruits and leaves; and what Del takes away.
namespace pedicel::app {

namespace {

constexpr float point_reach = 7.0f;   // px
constexpr double organ_reach = 60.0;  // px, of an organ from the stem that it goes to

bool mouse_moved() {
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  return moved.x != 0.0f || moved.y != 0.0f;
}

}  // namespace

void DrawTool::choose_point(Ui& ui, int point) {
  stem_ = chosen_curve(ui, plant_)->name;
  ui.selection = {};
  ui.selection.kind = Selection::Kind::curve_point;
  ui.selection.plant_name = plant_, ui.selection.curve = stem_, ui.selection.point = point;
}

int DrawTool::point_under(const Ui& ui, const SceneFrame& frame) const {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return -1;
  const Pose pose = plant_pose(ui.session, plant);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  int best = -1;
  float least = point_reach * ui.scale;
  for (const plant::ControlPoint& one : plant::control_points(*curve)) {
    const auto at = frame.project(pose * curve->points[static_cast<std::size_t>(one.index)]);
    if (!at) continue;
    const float off = std::hypot(at->x - mouse.x, at->y - mouse.y);
    if (off < least) least = off, best = one.index;
  }
  return best;
}

bool DrawTool::press_handle(Ui& ui, const SceneFrame& frame) {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve || point_under(ui, frame) >= 0) return false;
  const auto found =
      handle_at(radius_handles(*curve, plant_pose(ui.session, plant), frame, ui.scale), pressed_at_,
                ui.scale);
  if (!found) return false;
  handle_ = *found;
  point_ = handle_.point;
  choose_point(ui, point_);
  hand_ = Hand::radius;
  ui.session.begin_gesture();
  return true;
}

void DrawTool::move_radius(Ui& ui) {
  if (!mouse_moved()) return;
  const double radius = handle_.dragged(pressed_at_, ImGui::GetIO().MousePos);
  ui.run(Command("set radius",
                 {{"plant", plant_}, {"stem", stem_}, {"radius", radius}, {"point", point_}}));
}

bool DrawTool::press_organ(Ui& ui, const SceneFrame& frame) {
  const auto organ = organ_of(ui, ui.hover);
  if (!organ) return false;
  const auto curve = drawn_curve(ui.session, organ->plant, organ->place.curve);
  if (!curve) return false;
  plant_ = organ->plant, organ_ = organ->name;
  const Pose pose = plant_pose(ui.session, plant_);
  const Vec3 drawn = pose * curve->point(organ->place.at * curve->length());
  // Where the drawing's place is in the simulation: near enough along the same rods.
  Vec3 now = drawn;
  if (const auto at =
          find_organ(*ui.snapshot, plant_ + "/" + organ->place.curve, organ->place.at)) {
    const PlantSnapshot& plant = ui.snapshot->plants[static_cast<std::size_t>(at->plant)];
    now = point_on(*plant.model, plant.state, at->element, at->back);
  }
  moved_ = now - drawn;
  const ImVec2 foot = frame.project(now).value_or(pressed_at_);
  grip_ = ImVec2(pressed_at_.x - foot.x, pressed_at_.y - foot.y);
  stems_.emplace(*plant_file(ui.session, plant_));
  foot_ = StemHit{plant_, organ->place.curve, organ->place.at, organ->place.at, drawn, now};
  ui.selection = ui.hover;
  hand_ = Hand::organ;
  ui.session.begin_gesture();
  return true;
}

/// Along the stem that the organ's foot is led over; it stays where it was while none is near.
void DrawTool::move_organ(Ui& ui, const SceneFrame& frame) {
  if (!mouse_moved()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const geometry::Ray ray = frame.ray(ImVec2(mouse.x - grip_.x, mouse.y - grip_.y));
  const Pose pose = plant_pose(ui.session, plant_), to_plant = pose.inverse();
  const auto place =
      stems_->under_ray(to_plant * Vec3(ray.origin - moved_), to_plant.rotation * ray.direction,
                        0.0, frame.angle(organ_reach * ui.scale));
  if (!place) return;
  const Vec3 drawn = pose * place->point;
  foot_ = StemHit{plant_, place->stem, place->at, place->at, drawn, drawn + moved_};
  ui.run(Command("move organ",
                 {{"plant", plant_}, {"name", organ_}, {"stem", place->stem}, {"at", place->at}}));
}

void DrawTool::move_point(Ui& ui, const SceneFrame& frame) {
  const plant::PlantFile* file = plant_file(ui.session, plant_);
  const int c = file ? file->curve_index(stem_) : -1;
  if (c < 0 || !mouse_moved() ||
      point_ >= static_cast<int>(file->curves[static_cast<std::size_t>(c)].points.size()))
    return;
  const Pose pose = plant_pose(ui.session, plant_);
  const Vec3 now =
      pose * file->curves[static_cast<std::size_t>(c)].points[static_cast<std::size_t>(point_)];
  const Vec3 view = frame.camera.target - frame.camera.eye;
  const DrawPlane plane = ui.draw.plane == PlaneChoice::ground    ? ground_plane(now.z())
                          : ui.draw.plane == PlaneChoice::upright ? upright_plane(view, now)
                                                                  : view_plane(view, now);
  if (const auto to = meet(frame.ray(ImGui::GetIO().MousePos), plane))
    ui.run(Command("move point", {{"plant", plant_},
                                  {"stem", stem_},
                                  {"point", point_},
                                  {"to", Vec3(pose.inverse() * *to)}}));
}

void DrawTool::remove_selected(Ui& ui) {
  std::string plant;
  if (const auto organ = organ_of(ui, ui.selection)) {
    if (ui.remove(Command("delete organ", {{"plant", organ->plant}, {"name", organ->name}})))
      ui.selection = {};
    return;
  }
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return;
  const std::string stem = curve->name;
  if (ui.selection.to_tip) {
    const auto place = stem_hit(ui, ui.selection);
    if (place &&
        ui.remove(Command("trim stem", {{"plant", plant}, {"stem", stem}, {"at", place->at}})))
      ui.selection = {};
  } else if (ui.selection.kind == Selection::Kind::curve_point) {
    if (ui.run(Command("delete point",
                       {{"plant", plant}, {"stem", stem}, {"point", ui.selection.point}})))
      choose_curve(ui, plant, stem);
  } else if (ui.remove(Command("delete stem", {{"plant", plant}, {"stem", stem}}))) {
    ui.selection = {};
  }
}

}  // namespace pedicel::app
