#include "app/tools/radius_handles.h"

#include <algorithm>
#include <cmath>

#include "plugins/plant/plant_edit.h"
#include "plugins/plant/point_kind.h"

namespace pedicel::app {

namespace {

constexpr double gap_px = 13.0;   // from the outline: clear of the control point's own ball
constexpr double reach_px = 6.5;  // of the pointer
constexpr double least = 1.0e-4;  // m, of a radius

std::optional<RadiusHandle> handle_at(const Vec3& centre, const Vec3& across, double radius,
                                      int point, const SceneFrame& frame, double scale) {
  RadiusHandle made;
  made.point = point, made.radius = radius;
  const double depth = (centre - frame.camera.eye).norm();
  made.metres = depth / frame.camera.focal_length(frame.height());
  made.surface = centre + radius * across;
  made.place = made.surface + scale * gap_px * made.metres * across;
  const auto middle = frame.project(centre), at = frame.project(made.place);
  if (!middle || !at) return {};
  made.at = *at;
  const float dx = at->x - middle->x, dy = at->y - middle->y, way = std::hypot(dx, dy);
  if (way < 2.0f) return {};
  made.away = ImVec2(dx / way, dy / way);
  return made;
}

}  // namespace

double RadiusHandle::dragged(const ImVec2& from, const ImVec2& to) const {
  const double px = static_cast<double>((to.x - from.x) * away.x + (to.y - from.y) * away.y);
  return std::max(least, radius + px * metres);
}

std::vector<RadiusHandle> radius_handles(const plant::PlantCurve& curve, const Pose& pose_W,
                                         const SceneFrame& frame, double scale) {
  std::vector<RadiusHandle> handles;
  if (curve.radius.empty() || curve.points.size() < 2) return handles;
  plant::PlantFile alone;
  alone.curves = {curve};
  const geometry::Curve drawn = plant::stem_curve(alone, curve.name);
  for (const plant::ControlPoint& one : plant::control_points(curve)) {
    const double arc = drawn.control_arc(one.index);
    const Vec3 centre = pose_W * drawn.point(arc);
    const Vec3 along = pose_W.rotation * drawn.tangent(arc);
    const Vec3 across = along.cross((centre - frame.camera.eye).normalized());
    if (across.norm() < 0.1) continue;
    for (const double side : {-1.0, 1.0})
      if (const auto made = handle_at(centre, side * across.normalized(), drawn.radius(arc),
                                      one.index, frame, scale))
        handles.push_back(*made);
  }
  return handles;
}

std::optional<RadiusHandle> handle_at(const std::vector<RadiusHandle>& handles, const ImVec2& at,
                                      double scale) {
  const auto off = [&at](const RadiusHandle& one) {
    return std::hypot(one.at.x - at.x, one.at.y - at.y);
  };
  const auto best = std::ranges::min_element(handles, {}, off);
  if (best == handles.end() || off(*best) > reach_px * scale) return {};
  return *best;
}

}  // namespace pedicel::app
