#include <algorithm>
#include <cmath>

#include "pedicel/app/editors/stem_editor.h"
#include "pedicel/app/tools/draw_tool.h"
#include "pedicel/app/view/picking.h"
#include "pedicel/plant/plant_edit.h"

/// Strokes that become stems, and fruits and leaves that are put on.
namespace pedicel::app {

namespace {

constexpr double shortest_stem = 0.004;  // m
constexpr double farthest = 5.0;         // m, of a stroke from its start
constexpr double nearest = 2e-4;         // m, of two places of a stroke

std::string unused_name(const Session& session, const std::string& plant,
                        const std::string& wanted) {
  const plant::PlantFile* file = plant_file(session, plant);
  return file ? plant::free_name(*file, wanted) : wanted;
}

std::string unused_plant(const Session& session) {
  std::string name = "plant";
  for (int i = 2; session.document().plant_index(name) >= 0; ++i)
    name = "plant_" + std::to_string(i);
  return name;
}

double length_of(const std::vector<plant::StrokeSample>& stroke) {
  double length = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i)
    length += (stroke[i].position - stroke[i - 1].position).norm();
  return length;
}

/// m, of the stem that a stroke begins on, there.
double radius_at(const Session& session, const StemHit& foot) {
  const auto curve = drawn_curve(session, foot.plant, foot.stem);
  return curve ? curve->radius(foot.at * curve->length()) : 0.0;
}

/// A branch is no thicker than what it grows from.
void keep_thinner(std::vector<double>& radius, double parent) {
  if (radius.empty() || !(parent > 0.0) || radius.front() <= parent) return;
  const double share = parent / radius.front();
  for (double& one : radius) one *= share;
}

ProjectorOptions projector_options(const DrawMode& d, double height) {
  ProjectorOptions options;
  const bool creeps = d.depth == DrawDepth::surface && !d.only_first;
  if (creeps)
    options.plane = StrokePlane::surface;
  else if (d.plane == PlaneChoice::ground)
    options.plane = StrokePlane::ground;
  else if (d.plane == PlaneChoice::tangent)
    options.plane = StrokePlane::tangent;
  else if (d.plane == PlaneChoice::view)
    options.plane = StrokePlane::view;
  options.only_first = d.only_first;
  options.offset = creeps ? d.offset : 0.0;
  options.ground = height;
  return options;
}

/// What a hand draws is no finer, and files are read by people: "0.0123", not 17 digits.
double to_micrometre(double value) {
  return std::round(1e6 * value) / 1e6 + 0.0;  // not -0
}
Vec3 to_micrometres(const Vec3& point) {
  return {to_micrometre(point.x()), to_micrometre(point.y()), to_micrometre(point.z())};
}

}  // namespace

/// Its depth is that of the stem it begins on, of what lies under the pointer, or of the orbit's
/// centre.
void DrawTool::begin_stroke(Ui& ui, const SceneFrame& frame) {
  hand_ = Hand::stroke;
  thickness_ = 1.0;
  const Vec3 view = (frame.camera.target - frame.camera.eye).normalized();
  const Vec3 start = foot_                                 ? foot_->now_W
                     : ui.draw.depth == DrawDepth::surface ? ui.hover.place_W
                                                           : Vec3(frame.camera.target);
  const ProjectorOptions options = projector_options(ui.draw, start.z());
  surfaces_.reset();
  if (options.plane == StrokePlane::surface) surfaces_ = std::make_unique<Surfaces>(*ui.snapshot);
  projector_.emplace(options, view, surfaces_.get());
  projector_->set_fallback(start);
  if (foot_) {
    Vec3 along = Vec3::UnitZ();
    if (const auto curve = drawn_curve(ui.session, foot_->plant, foot_->stem))
      along = plant_pose(ui.session, foot_->plant).rotation *
              curve->tangent(foot_->at * curve->length());
    projector_->start_on_stem(foot_->now_W, along);
  }
  const auto first = projector_->place(frame.ray(ImGui::GetIO().MousePos));
  stroke_ = {{first.value_or(start), 1.0}};
}

void DrawTool::extend_stroke(const Ui&, const SceneFrame& frame) {
  const auto at = projector_->place(frame.ray(ImGui::GetIO().MousePos));
  if (!at || (*at - stroke_.front().position).norm() > farthest) return;
  if ((*at - stroke_.back().position).norm() > nearest) stroke_.push_back({*at, thickness_});
}

/// A stroke that starts on a stem becomes its branch; any other one the first stem of a plant of
/// its own. Points are moved by what the simulation has moved the foot from its drawing.
void DrawTool::end_stroke(Ui& ui) {
  const std::vector<plant::StrokeSample> stroke = std::move(stroke_);
  stroke_.clear();
  if (length_of(stroke) < shortest_stem) return;
  const DrawMode& d = ui.draw;
  const auto shape = shape_of(stroke, d);
  if (!shape) return;
  std::vector<Vec3> points = shape->points;
  std::vector<double> radius = shape->radius;
  if (foot_) keep_thinner(radius, radius_at(ui.session, *foot_));
  for (double& value : radius) value = std::max(to_micrometre(value), 1e-6);
  ui.session.begin_gesture();
  bool taken = true;
  std::string plant = foot_ ? foot_->plant : d.plant;
  const plant::PlantFile* file = plant_file(ui.session, plant);
  const Vec3 start = to_micrometres(points.front());
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
  for (Vec3& point : points) point = to_micrometres(to_plant * Vec3(point + offset));
  const std::string stem = unused_name(ui.session, plant, foot_ ? "branch" : "stem");
  taken = taken && ui.run(Command(
                       "draw stem",
                       {{"plant", plant}, {"stem", stem}, {"points", points}, {"radius", radius}}));
  if (!taken) return ui.session.cancel_gesture();
  ui.session.end_gesture();
  ui.draw.plant = plant;
  // Not chosen: its points would be in the way of the next branch.
  ui.selection = {};
}

void DrawTool::put_organ(Ui& ui, const StemHit& place) {
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
                                 {"stretch", d.fruit_stretch},
                                 {"force", d.fruit_force}}));
  else
    ui.run(Command("add leaf", {{"plant", place.plant},
                                {"name", name},
                                {"stem", place.stem},
                                {"at", place.at},
                                {"size", d.leaf_size},
                                {"template", d.leaf_template}}));
}

}  // namespace pedicel::app
