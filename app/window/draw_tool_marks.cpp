#include <algorithm>
#include <cmath>

#include "app/panels/stem_editor.h"
#include "app/window/draw_tool.h"

namespace pedicel::app {

namespace {

using render::Colour;

constexpr render::Material snap{Colour::hex(0x39c46a), 0.5f, 0.3f};
constexpr render::Material handle{Colour::hex(0xf4f6f8), 0.5f, 0.2f};
constexpr render::Material chosen_handle{Colour::hex(0xffb020), 0.5f, 0.2f};
constexpr render::Material node{Colour::hex(0x2f6fd0), 0.6f, 0.2f};
constexpr Colour line{Colour::hex(0xffffff)};

/// m, of a ball that covers so many pixels there.
double size_of(const SceneFrame& frame, const Vec3& place, double px) {
  return px * (place - frame.camera.eye).norm() / frame.camera.focal_length(frame.height());
}

void add_curve_line(render::DrawList& list, const geometry::Curve& curve, const Pose& pose) {
  const std::vector<double> arcs = curve.sample_arcs(std::max(curve.length() / 60.0, 1e-4));
  for (std::size_t i = 1; i < arcs.size(); ++i)
    list.lines.push_back(
        {pose * curve.point(arcs[i - 1]), pose * curve.point(arcs[i]), line, 1.5f});
}

}  // namespace

std::string DrawTool::label() const {
  if (hand_ == Hand::stroke) {
    double length = 0.0;
    for (std::size_t i = 1; i < stroke_W_.size(); ++i)
      length += (stroke_W_[i] - stroke_W_[i - 1]).norm();
    return std::to_string(static_cast<int>(std::lround(1e3 * length))) + " mm";
  }
  return hand_ == Hand::idle && foot_ ? "on " + foot_->plant + "/" + foot_->stem : "";
}

Vec3 DrawTool::label_place() const {
  if (hand_ == Hand::stroke && !stroke_W_.empty()) return stroke_W_.back();
  return foot_ ? foot_->now_W : start_W_;
}

void DrawTool::add_points(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return;
  const Pose pose = plant_pose(ui.session, plant);
  if (const auto drawn = drawn_curve(ui.session, plant, curve->name))
    add_curve_line(list, *drawn, pose);
  for (std::size_t i = 0; i < curve->points.size(); ++i) {
    const Vec3 place = pose * curve->points[i];
    const bool is_chosen = ui.selection.kind == Selection::Kind::curve_point &&
                           ui.selection.point == static_cast<int>(i);
    list.spheres.push_back(
        {place, size_of(frame, place, is_chosen ? 6.0 : 4.5), is_chosen ? chosen_handle : handle});
  }
}

/// The stem that the stroke would become, as a tube, and the nodes that `distance` would keep.
void DrawTool::add_to(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  if (!ui.draw.on) return;
  add_points(list, ui, frame);
  const DrawMode& d = ui.draw;
  if (foot_ && hand_ == Hand::idle)
    list.spheres.push_back({foot_->now_W, size_of(frame, foot_->now_W, 6.0), snap});
  if (hand_ != Hand::stroke || stroke_W_.size() < 2) return;
  list.spheres.push_back({start_W_, size_of(frame, start_W_, 5.0), snap});
  const auto shape = shape_of(stroke_W_, d);
  if (!shape) return;
  const geometry::Curve curve = geometry::Curve::smooth(shape->points, shape->radius);
  std::vector<render::TubePoint> tube;
  for (const double arc : curve.sample_arcs(std::max(curve.length() / 80.0, 1e-3)))
    tube.push_back({curve.point(arc), curve.radius(arc), Colour::hex(0x8fc25a)});
  list.add_tube(tube);
  const plant::PlantFile* file = plant_file(ui.session, foot_ ? foot_->plant : d.plant);
  const double distance = file && file->distance > 0.0 ? file->distance : 0.02;
  const int nodes = std::min(200, static_cast<int>(curve.length() / distance));
  for (int i = 1; i <= nodes; ++i) {
    const double arc = i * distance;
    list.spheres.push_back({curve.point(arc),
                            std::max(1.25 * curve.radius(arc), size_of(frame, start_W_, 2.5)),
                            node});
  }
}

}  // namespace pedicel::app
