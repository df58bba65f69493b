#pragma once

#include <optional>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/geometry/curve.h"
#include "plugins/plant/plant_file.h"

/// The paper's authoring pipeline, stage by stage: curves -> samples -> one tree -> kept nodes.
/// Everything is in the plant's own frame P, in metres.
namespace pedicel::plant {

/// The drawn curves with their interpolation and radii. A curve with a rectangle and no radius gets
/// half of its smaller extent as its radius for contact and drawing.
std::vector<geometry::Curve> make_curves(const PlantFile& plant);

/// The sampling step: smaller than the closest distance between any two curves, at most a quarter
/// of `distance` (so that kept nodes lie where the rule puts them), and, where curves touch or
/// nearly do, not below a quarter of the smaller of `connect` and `distance` (the floor).
double sampling_step(const std::vector<geometry::Curve>& curves, double connect, double distance);

/// A sampled place of a curve in the tree.
struct GraphNode {
  Vec3 position = Vec3::Zero();  ///< m, P
  int curve = -1;                ///< the curve that it was sampled from
  double arc = 0.0;              ///< m along that curve as drawn
  int parent = -1;               ///< -1: the root
  std::vector<int> children;
  bool carries = false;  ///< something starts here (a curve, a leaf): a key node
  bool kept = true;

  /// Junctions (degree over 2), leaf nodes (degree 1) and places that carry something.
  bool is_key() const { return carries || parent < 0 || children.size() != 1; }
};

/// A plant as a tree of nodes; a parent stands before its children.
struct PlantGraph {
  std::vector<GraphNode> nodes;
  std::vector<double> start_arc;  ///< m, of each curve: the arc at which it leaves its joint

  /// Sum of the straight lengths between kept nodes (m).
  double kept_length() const;
  /// The nearest kept node above a node; -1 for the root.
  int kept_parent(int node) const;
};

/// Samples the curves and joins them to one tree: the end nearest to the root is the root; then,
/// breadth first, every curve whose end lies nearer than `connect` to a node of another curve is
/// joined to the nearest such node, as soon as that curve is in the tree itself. A curve that
/// reaches nothing is an error that names it and how far it missed; then nothing comes back.
/// `leaf_places` are where leaves start: they become nodes. With `junction` > 0 (m) the foot of
/// every curve is a node of the curve that it is joined to, and the place so far below it a key
/// node: the short segment between them turns as the junction does.
std::optional<PlantGraph> connect(const PlantFile& plant,
                                  const std::vector<geometry::Curve>& curves,
                                  Diagnostics& diagnostics, double junction = 0.0);

/// Marks which nodes are kept. Key nodes are. Going depth first from the root, a node is kept once
/// it is `distance` along the path from the last kept one above it; where a key node then lies
/// nearer than half of `distance` below a kept node that is no key node, that one goes.
void simplify(PlantGraph& graph, double distance);

}  // namespace pedicel::plant
