#include <algorithm>
#include <cmath>

#include "pedicel/app/editors/stem_editor.h"
#include "pedicel/app/tools/draw_tool.h"
#include "pedicel/plant/point_kind.h"

namespace pedicel::app {

namespace {

using render::Colour;

constexpr render::Shading snap{Colour::hex(0x39c46a), 0.5f, 0.3f};
constexpr render::Shading handle{Colour::hex(0xf4f6f8), 0.5f, 0.2f};
constexpr render::Shading chosen_handle{Colour::hex(0xffb020), 0.5f, 0.2f};
constexpr render::Shading node{Colour::hex(0x2f6fd0), 0.6f, 0.2f};
constexpr render::Shading radius_handle{Colour::hex(0x37b6d6), 0.5f, 0.2f};
constexpr render::Shading cut{Colour::hex(0xf0402d), 0.5f, 0.2f};
constexpr Colour line{Colour::hex(0xffffff)}, outline{Colour::hex(0x37b6d6)};

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

/// The stem's edges in the picture, as it is drawn: they follow a dragged radius at once, before
/// the simulation has built the stem anew.
void add_outline(render::DrawList& list, const geometry::Curve& curve, const Pose& pose,
                 const SceneFrame& frame) {
  const std::vector<double> arcs = curve.sample_arcs(std::max(curve.length() / 60.0, 1e-4));
  for (const double side : {-1.0, 1.0}) {
    std::optional<Vec3> last;
    for (const double arc : arcs) {
      const Vec3 centre = pose * curve.point(arc);
      const Vec3 across = (pose.rotation * curve.tangent(arc)).cross(centre - frame.camera.eye);
      const Vec3 edge = centre + side * curve.radius(arc) * across.normalized();
      if (last) list.lines.push_back({*last, edge, outline, 1.0f});
      last = edge;
    }
  }
}

}  // namespace

void DrawTool::add_points(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return;
  const Pose pose = plant_pose(ui.session, plant);
  const auto drawn = drawn_curve(ui.session, plant, curve->name);
  if (drawn) add_curve_line(list, *drawn, pose);
  if (drawn && !curve->radius.empty()) add_outline(list, *drawn, pose, frame);
  const bool point_chosen = ui.selection.kind == Selection::Kind::curve_point;
  for (const plant::ControlPoint& one : plant::control_points(*curve)) {
    const Vec3 centre = pose * curve->points[static_cast<std::size_t>(one.index)];
    // In front of the stem, which would hide it.
    const double radius = drawn ? drawn->radius(drawn->control_arc(one.index)) : 0.0;
    const Vec3 place = centre + 1.3 * radius * (frame.camera.eye - centre).normalized();
    const bool is_chosen = point_chosen && ui.selection.point == one.index;
    const render::Shading& look = is_chosen ? chosen_handle : handle;
    const double size = size_of(frame, place, is_chosen ? 6.0 : 4.5);
    if (one.kind == plant::PointKind::smooth)
      list.spheres.push_back({place, size, look});
    else
      list.boxes.push_back({{place, Quat::Identity()}, Vec3::Constant(0.8 * size), look});
  }
  for (const RadiusHandle& one : radius_handles(*curve, pose, frame, ui.scale)) {
    const bool held = hand_ == Hand::radius && one.point == point_;
    list.spheres.push_back(
        {one.place, size_of(frame, one.place, 3.5), held ? chosen_handle : radius_handle});
    list.lines.push_back({one.surface, one.place, outline, 1.0f});
  }
}

/// The stem that the stroke would become, as a tube, and the nodes that `distance` would keep.
void DrawTool::add_stroke(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  const Vec3& start = stroke_.front().position;
  list.spheres.push_back({start, size_of(frame, start, 5.0), snap});
  const auto shape = shape_of(stroke_, ui.draw);
  if (!shape) return;
  const geometry::Curve curve = geometry::Curve::smooth(shape->points, shape->radius);
  std::vector<render::TubePoint> tube;
  for (const double arc : curve.sample_arcs(std::max(curve.length() / 80.0, 1e-3)))
    tube.push_back({curve.point(arc), curve.radius(arc), Colour::hex(0x8fc25a)});
  list.add_tube(tube);
  const plant::PlantFile* file = plant_file(ui.session, foot_ ? foot_->plant : ui.draw.plant);
  const double distance = file && file->distance > 0.0 ? file->distance : 0.02;
  const int nodes = std::min(200, static_cast<int>(curve.length() / distance));
  for (int i = 1; i <= nodes; ++i) {
    const double arc = i * distance;
    list.spheres.push_back(
        {curve.point(arc), std::max(1.25 * curve.radius(arc), size_of(frame, start, 2.5)), node});
  }
}

void DrawTool::add_to(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  if (!ui.draw.on) return;
  add_points(list, ui, frame);
  const bool cuts = ui.draw.thing == DrawThing::trim;
  if (foot_ && (hand_ == Hand::idle || hand_ == Hand::organ)) {
    list.spheres.push_back({foot_->now_W, size_of(frame, foot_->now_W, 6.0), cuts ? cut : snap});
    if (cuts) add_beyond(list, *ui.snapshot, *foot_);
  }
  if (hand_ == Hand::stroke && stroke_.size() > 1) add_stroke(list, ui, frame);
  if (hand_ == Hand::trim) trim_.add_to(list, ui, frame);
  if (hand_ == Hand::tie) tie_.add_to(list);
}

}  // namespace pedicel::app
