#include "app/window/draw_tool.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/panels/stem_editor.h"

namespace pedicel::app {

namespace {

constexpr double shortest_stem = 0.004;  // m
constexpr float point_reach = 7.0f;      // px

std::string unused_name(const Session& session, const std::string& plant, const std::string& stem) {
  const plant::PlantFile* file = plant_file(session, plant);
  const auto taken = [&](const std::string& name) {
    if (!file) return false;
    const auto named = [&name](const auto& one) { return one.name == name; };
    return std::ranges::any_of(file->curves, named) || std::ranges::any_of(file->fruits, named) ||
           std::ranges::any_of(file->leaves, named);
  };
  if (!taken(stem)) return stem;
  int number = 2;
  while (taken(stem + "_" + std::to_string(number))) ++number;
  return stem + "_" + std::to_string(number);
}

std::string unused_plant(const Session& session) {
  std::string name = "plant";
  for (int i = 2; session.document().plant_index(name) >= 0; ++i)
    name = "plant_" + std::to_string(i);
  return name;
}

double length_of(const std::vector<Vec3>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

}  // namespace

bool DrawTool::update(Ui& ui, const SceneFrame& frame, const RigidShapes& shapes) {
  if (!ui.draw.on) {
    if (hand_ != Hand::idle) cancel(ui);
    foot_.reset();
    return false;
  }
  if (hand_ == Hand::idle) {
    foot_ = stem_place(ui, ui.hover);
    const bool camera = ImGui::GetIO().KeyAlt || ImGui::GetIO().KeyCtrl;
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(0) && !camera) press(ui, frame);
    return true;
  }
  if (hand_ == Hand::stroke) extend_stroke(ui, frame, shapes);
  if (hand_ == Hand::point) move_point(ui, frame);
  if (hand_ == Hand::organ) {
    ui.hover = pick(*ui.snapshot, shapes, frame.ray(ImGui::GetIO().MousePos), frame.angle(12.0));
    move_organ(ui);
  }
  if (ImGui::IsMouseDown(0)) return true;
  if (hand_ == Hand::stroke)
    end_stroke(ui);
  else
    ui.session.end_gesture();
  hand_ = Hand::idle;
  return true;
}

void DrawTool::press(Ui& ui, const SceneFrame& frame) {
  point_ = point_under(ui, frame);
  if (point_ >= 0) {
    stem_ = chosen_curve(ui, plant_)->name;
    ui.selection = {};
    ui.selection.kind = Selection::Kind::curve_point;
    ui.selection.plant_name = plant_, ui.selection.curve = stem_, ui.selection.point = point_;
    hand_ = Hand::point;
    ui.session.begin_gesture();
    return;
  }
  if (ui.hover.kind == Selection::Kind::fruit) {
    const std::string name = describe(ui.hover, *ui.snapshot);
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos) return;
    plant_ = name.substr(0, slash), organ_ = name.substr(slash + 1);
    ui.selection = ui.hover;
    hand_ = Hand::organ;
    ui.session.begin_gesture();
    return;
  }
  if (foot_ && ImGui::GetIO().KeyShift) {
    if (ui.run(Command("insert point",
                       {{"plant", foot_->plant}, {"stem", foot_->stem}, {"at", foot_->at}})))
      choose_curve(ui, foot_->plant, foot_->stem);
    return;
  }
  if (ui.draw.thing != DrawThing::stem) {
    if (foot_)
      put_organ(ui, *foot_);
    else
      ui.say("Click on a stem to put it there");
    return;
  }
  begin_stroke(ui, frame);
}

void DrawTool::begin_stroke(Ui& ui, const SceneFrame&) {
  hand_ = Hand::stroke;
  start_W_ = foot_ ? foot_->now_W : ui.hover.place_W;
  if (foot_ && ui.draw.depth == DrawDepth::cursor) start_W_ = foot_->now_W;
  stroke_W_ = {start_W_};
}

Vec3 DrawTool::plane_normal(const Ui& ui, const SceneFrame& frame) const {
  const Vec3 back = (frame.camera.eye - frame.camera.target).normalized();
  if (ui.draw.plane == PlaneChoice::ground) return Vec3::UnitZ();
  if (ui.draw.plane == PlaneChoice::view || !foot_) return back;
  const auto curve = drawn_curve(ui.session, foot_->plant, foot_->stem);
  if (!curve) return back;
  const Vec3 along =
      plant_pose(ui.session, foot_->plant).rotation * curve->tangent(foot_->at * curve->length());
  const Vec3 across = back - back.dot(along) * along;
  return across.norm() > 0.1 ? Vec3(across.normalized()) : back;
}

void DrawTool::extend_stroke(Ui& ui, const SceneFrame& frame, const RigidShapes& shapes) {
  const render::Ray ray = frame.ray(ImGui::GetIO().MousePos);
  auto at = hit_plane(ray, start_W_, plane_normal(ui, frame));
  if (ui.draw.depth == DrawDepth::surface && !ui.draw.only_first) {
    const Selection hit = pick(*ui.snapshot, shapes, ray, 0.0);
    if (hit) at = hit.place_W - ui.draw.offset * ray.direction;
  }
  if (!at || (*at - start_W_).norm() > 5.0) return;
  if ((*at - stroke_W_.back()).norm() > 2e-4) stroke_W_.push_back(*at);
}

/// A stroke that starts on a stem becomes its branch; any other one the first stem of a plant of
/// its own. Points are moved by what the simulation has moved the foot from its drawing.
void DrawTool::end_stroke(Ui& ui) {
  std::vector<Vec3> stroke = std::move(stroke_W_);
  stroke_W_.clear();
  if (length_of(stroke) < shortest_stem) {
    if (foot_) choose_curve(ui, foot_->plant, foot_->stem);  // a click
    return;
  }
  const DrawMode& d = ui.draw;
  const auto shape = shape_of(stroke, d);
  if (!shape) return;
  std::vector<Vec3> points = shape->points;
  ui.session.begin_gesture();
  bool taken = true;
  std::string plant = foot_ ? foot_->plant : d.plant;
  const plant::PlantFile* file = plant_file(ui.session, plant);
  const Vec3 start = points.front();
  if (!foot_) {
    if (!file || !file->curves.empty()) {
      plant = unused_plant(ui.session);
      taken = ui.run(Command("new plant", {{"plant", plant}, {"position", start}}));
    } else {
      taken = ui.run(Command("move plant", {{"plant", plant}, {"to", start}}));
    }
  }
  const Vec3 offset = foot_ ? Vec3(foot_->drawn_W - foot_->now_W) : Vec3(Vec3::Zero());
  const Pose to_plant = plant_pose(ui.session, plant).inverse();
  for (Vec3& point : points) point = to_plant * Vec3(point + offset);
  const std::string stem = unused_name(ui.session, plant, foot_ ? "branch" : "stem");
  taken = taken &&
          ui.run(Command(
              "draw stem",
              {{"plant", plant}, {"stem", stem}, {"points", points}, {"radius", shape->radius}}));
  if (!taken) return ui.session.cancel_gesture();
  ui.session.end_gesture();
  ui.draw.plant = plant;
  // Not chosen: its points would be in the way of the next branch.
  ui.selection = {};
}

void DrawTool::put_organ(Ui& ui, const StemPlace& place) {
  const DrawMode& d = ui.draw;
  const bool fruit = d.thing == DrawThing::fruit;
  const std::string name = unused_name(ui.session, place.plant, fruit ? "fruit" : "leaf");
  if (fruit)
    ui.run(Command("add fruit", {{"plant", place.plant},
                                 {"name", name},
                                 {"stem", place.stem},
                                 {"at", place.at},
                                 {"radius", d.fruit_radius},
                                 {"density", d.fruit_density},
                                 {"stretch", d.fruit_stretch}}));
  else
    ui.run(Command("add leaf", {{"plant", place.plant},
                                {"name", name},
                                {"stem", place.stem},
                                {"at", place.at},
                                {"size", d.leaf_size}}));
}

int DrawTool::point_under(const Ui& ui, const SceneFrame& frame) const {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return -1;
  const Pose pose = plant_pose(ui.session, plant);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  int best = -1;
  float least = point_reach * ui.scale;
  for (std::size_t i = 0; i < curve->points.size(); ++i) {
    const auto at = frame.project(pose * curve->points[i]);
    if (!at) continue;
    const float off = std::hypot(at->x - mouse.x, at->y - mouse.y);
    if (off < least) least = off, best = static_cast<int>(i);
  }
  return best;
}

void DrawTool::move_point(Ui& ui, const SceneFrame& frame) {
  const plant::PlantFile* file = plant_file(ui.session, plant_);
  const int c = file ? file->curve_index(stem_) : -1;
  if (c < 0 || point_ >= static_cast<int>(file->curves[static_cast<std::size_t>(c)].points.size()))
    return;
  const Pose pose = plant_pose(ui.session, plant_);
  const Vec3 now =
      pose * file->curves[static_cast<std::size_t>(c)].points[static_cast<std::size_t>(point_)];
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (moved.x == 0.0f && moved.y == 0.0f) return;
  const Vec3 normal = ui.draw.plane == PlaneChoice::ground
                          ? Vec3(Vec3::UnitZ())
                          : Vec3((frame.camera.eye - frame.camera.target).normalized());
  const auto to = hit_plane(frame.ray(ImGui::GetIO().MousePos), now, normal);
  if (to)
    ui.run(Command("move point", {{"plant", plant_},
                                  {"stem", stem_},
                                  {"point", point_},
                                  {"to", Vec3(pose.inverse() * *to)}}));
}

void DrawTool::move_organ(Ui& ui) {
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  const auto place = stem_place(ui, ui.hover);
  if (!place || place->plant != plant_ || (moved.x == 0.0f && moved.y == 0.0f)) return;
  ui.run(Command("move organ",
                 {{"plant", plant_}, {"name", organ_}, {"stem", place->stem}, {"at", place->at}}));
}

bool DrawTool::cancel(Ui& ui) {
  if (hand_ == Hand::idle) return false;
  if (hand_ == Hand::stroke)
    stroke_W_.clear();
  else
    ui.session.cancel_gesture();
  hand_ = Hand::idle;
  return true;
}

void DrawTool::remove_selected(Ui& ui) {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (ui.selection.kind == Selection::Kind::fruit) {
    const std::string name = describe(ui.selection, *ui.snapshot);
    const std::size_t slash = name.find('/');
    if (slash != std::string::npos &&
        ui.run(Command("delete organ",
                       {{"plant", name.substr(0, slash)}, {"name", name.substr(slash + 1)}})))
      ui.selection = {};
  } else if (curve && ui.selection.kind == Selection::Kind::curve_point) {
    const std::string stem = curve->name;
    if (ui.run(Command("delete point",
                       {{"plant", plant}, {"stem", stem}, {"point", ui.selection.point}})))
      choose_curve(ui, plant, stem);
  } else if (curve) {
    if (ui.run(Command("delete stem", {{"plant", plant}, {"stem", curve->name}})))
      ui.selection = {};
  }
}

}  // namespace pedicel::app
