#include "plugins/plant/stem_tree.h"

#include <limits>

#include "engine/geometry/curve_distance.h"
#include "plugins/plant/plant_graph.h"

namespace pedicel::plant {

namespace {

bool is_curve(const PlantCurve& curve) {
  return curve.points.size() >= 2;
}

int root_curve(const PlantFile& plant, StemJoint& joint) {
  int root = -1;
  joint.distance = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < plant.curves.size(); ++c) {
    const PlantCurve& curve = plant.curves[c];
    if (!is_curve(curve)) continue;
    for (const bool first : {true, false}) {
      const Vec3& end = first ? curve.points.front() : curve.points.back();
      const double distance = (end - plant.root).norm();
      if (distance >= joint.distance) continue;
      joint = {-1, true, first, 0.0, distance};
      root = static_cast<int>(c);
    }
  }
  return root;
}

/// The end of a curve that is nearest to another curve.
StemJoint joint_between(const PlantCurve& curve, int parent, const geometry::Curve& parent_curve) {
  StemJoint best{parent, true, true, 0.0, std::numeric_limits<double>::infinity()};
  for (const bool first : {true, false}) {
    const Vec3& end = first ? curve.points.front() : curve.points.back();
    const geometry::CurvePoint near = geometry::closest_on_curve(parent_curve, end);
    if (near.distance >= best.distance) continue;
    best.foot_first = first;
    best.parent_at = near.arc / parent_curve.length();
    best.distance = near.distance;
  }
  return best;
}

}  // namespace

std::vector<StemJoint> stem_tree(const PlantFile& plant) {
  std::vector<StemJoint> tree(plant.curves.size());
  StemJoint root_joint;
  const int root = root_curve(plant, root_joint);
  if (root < 0) return tree;
  tree[root] = root_joint;
  const std::vector<geometry::Curve> curves = make_curves(plant);
  std::vector<int> waiting = {root};
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    const int parent = waiting[next];
    for (std::size_t c = 0; c < plant.curves.size(); ++c) {
      if (tree[c].joined || !is_curve(plant.curves[c])) continue;
      const StemJoint joint = joint_between(plant.curves[c], parent, curves[parent]);
      if (joint.distance > plant.connect) continue;
      tree[c] = joint;
      waiting.push_back(static_cast<int>(c));
    }
  }
  return tree;
}

std::vector<int> branches_of(const std::vector<StemJoint>& tree, int curve) {
  std::vector<int> found = {curve};
  for (std::size_t next = 0; next < found.size(); ++next)
    for (std::size_t c = 0; c < tree.size(); ++c)
      if (tree[c].joined && tree[c].parent == found[next]) found.push_back(static_cast<int>(c));
  found.erase(found.begin());
  return found;
}

}  // namespace pedicel::plant
