#include "plugins/skeleton/skeleton.h"

#include <algorithm>

#include "engine/core/check.h"

namespace pedicel::plant {

namespace {

constexpr double same_place = 1.0e-9;  ///< m

/// Nodes that follow each other, and the node that they branch off from (-1: the root's axis).
struct Axis {
  int from = -1;
  std::vector<int> nodes;
};

// A node that continues an axis which another one continued before starts an axis of its own.
std::vector<Axis> make_axes(const std::vector<SkeletonNode>& nodes) {
  std::vector<Axis> axes;
  std::vector<int> axis_of;
  for (int n = 0; n < static_cast<int>(nodes.size()); ++n) {
    const int parent = nodes[n].parent;
    PEDICEL_ASSERT(parent < n);
    const bool continues =
        !nodes[n].branch && parent >= 0 && axes[axis_of[parent]].nodes.back() == parent;
    if (!continues) axes.push_back({parent, {}});
    axis_of.push_back(continues ? axis_of[parent] : static_cast<int>(axes.size()) - 1);
    axes[axis_of[n]].nodes.push_back(n);
  }
  return axes;
}

// A parent's axis comes before those that branch off from it.
std::vector<double> diameters(const std::vector<SkeletonNode>& nodes, const std::vector<Axis>& axes,
                              const MtgOptions& options) {
  const double smallest = options.smallest_diameter;
  std::vector<double> result(nodes.size(), 0.0);
  for (const Axis& axis : axes) {
    const auto known = std::find_if(axis.nodes.begin(), axis.nodes.end(),
                                    [&](int n) { return nodes[n].diameter.has_value(); });
    double current = known != axis.nodes.end() ? *nodes[*known].diameter
                     : axis.from >= 0          ? result[axis.from]
                                               : smallest;
    for (const int n : axis.nodes) {
      current = nodes[n].diameter.value_or(current);
      result[n] = options.keeps_thin && current > 0.0 ? current : std::max(current, smallest);
    }
  }
  return result;
}

PlantCurve axis_curve(const std::vector<SkeletonNode>& nodes, const Axis& axis,
                      const std::vector<double>& diameter) {
  PlantCurve curve;
  curve.interpolation = Interpolation::linear;
  curve.where = nodes[axis.nodes.front()].where;
  const auto add = [&](int node, double wide) {
    const Vec3& point = nodes[node].position;
    if (!curve.points.empty() && (point - curve.points.back()).norm() < same_place) return;
    curve.points.push_back(point);
    curve.radius.push_back(0.5 * wide);
  };
  if (axis.from >= 0) add(axis.from, diameter[axis.nodes.front()]);
  for (const int n : axis.nodes) add(n, diameter[n]);
  return curve;
}

}  // namespace

PlantFile skeleton_plant(const std::vector<SkeletonNode>& nodes, const std::string& name,
                         const MtgOptions& options) {
  PEDICEL_ASSERT(!nodes.empty());
  PlantFile plant;
  plant.name = name;
  plant.look = Look::apple;  // what people digitise are trees
  plant.material = {options.youngs_modulus, options.poisson_ratio, options.density,
                    options.damping_time};
  plant.connect = options.connect;
  plant.distance = options.distance;
  plant.root = nodes.front().position;
  plant.where = nodes.front().where;
  const std::vector<Axis> axes = make_axes(nodes);
  const std::vector<double> diameter = diameters(nodes, axes, options);
  for (const Axis& axis : axes) {
    PlantCurve curve = axis_curve(nodes, axis, diameter);
    if (curve.points.size() < 2) continue;
    curve.name = "axis_" + std::to_string(plant.curves.size() + 1);
    plant.curves.push_back(std::move(curve));
  }
  return plant;
}

std::optional<PlantFile> checked_skeleton_plant(const std::vector<SkeletonNode>& nodes,
                                                const std::string& name, const MtgOptions& options,
                                                Diagnostics& diagnostics) {
  if (nodes.empty()) return std::nullopt;
  PlantFile plant = skeleton_plant(nodes, name, options);
  if (plant.curves.empty()) {
    diagnostics.error(plant.where, nodes.size() == 1
                                       ? std::string("one node only, expected two or more")
                                       : "all " + std::to_string(nodes.size()) +
                                             " nodes lie at one place, expected them apart");
    return std::nullopt;
  }
  if (!check_plant(plant, diagnostics)) return std::nullopt;
  return plant;
}

}  // namespace pedicel::plant
