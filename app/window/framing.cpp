#include "app/window/framing.h"

#include <algorithm>

#include "app/editors/stem_editor.h"
#include "app/tools/drawn_shape.h"
#include "app/view/snapshot_view.h"
#include "plugins/plant/point_kind.h"

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;
using Box = Eigen::AlignedBox3d;

constexpr double least_margin = 0.02;  // m
constexpr double margin_share = 0.25;  // of the box's diagonal

void extend(Box& box, const Vec3& middle, double half) {
  box.extend(middle - Vec3::Constant(half));
  box.extend(middle + Vec3::Constant(half));
}

/// Half the way to the nearest other point, to all sides.
Box box_of_point(const plant::PlantCurve& curve, int point, const Pose& X_WP) {
  Box box;
  if (point < 0 || point >= static_cast<int>(curve.points.size())) return box;
  const Vec3& middle = curve.points[static_cast<std::size_t>(point)];
  double half = 0.0;
  for (const plant::ControlPoint& one : plant::control_points(curve)) {
    if (one.index == point) continue;
    const double way = (curve.points[static_cast<std::size_t>(one.index)] - middle).norm();
    half = half == 0.0 ? way : std::min(half, way);
  }
  extend(box, X_WP * middle, 0.5 * half);
  return box;
}

Box box_of_organ(const Snapshot& snapshot, const std::string& organ) {
  Box box;
  for (const PlantSnapshot& plant : snapshot.plants)
    for (int e = 0; e < plant.model->size(); ++e) {
      const cosserat::Element& element = plant.model->elements[static_cast<std::size_t>(e)];
      if (!plant.state.alive[static_cast<std::size_t>(e)] ||
          plant.model->organs[static_cast<std::size_t>(element.organ)] != organ)
        continue;
      box.extend(plant.state.position[static_cast<std::size_t>(e)]);
      box.extend(start_of(*plant.model, plant.state, e));
    }
  return box;
}

Box box_of_drawing(const Ui& ui) {
  std::string name;
  const plant::PlantCurve* curve = chosen_curve(ui, name);
  if (!curve) return {};
  const Pose X_WP = plant_pose(ui.session, name);
  if (ui.selection.kind == Kind::curve_point) return box_of_point(*curve, ui.selection.point, X_WP);
  const Box simulated = box_of_organ(*ui.snapshot, name + "/" + curve->name);
  if (!simulated.isEmpty()) return simulated;
  Box box;
  for (const Vec3& point : curve->points) box.extend(X_WP * point);
  return box;
}

}  // namespace

Eigen::AlignedBox3d frame_of(const Ui& ui, const RigidShapes& shapes) {
  const bool drawn = ui.selection.kind == Kind::curve || ui.selection.kind == Kind::curve_point;
  Box box = drawn ? box_of_drawing(ui) : bounds_of(ui.selection, *ui.snapshot, shapes);
  if (box.isEmpty()) return box;
  const double margin = std::max(least_margin, margin_share * box.diagonal().norm());
  box.extend(Vec3(box.max() + Vec3::Constant(margin)));
  box.extend(Vec3(box.min() - Vec3::Constant(margin)));
  return box;
}

}  // namespace pedicel::app
