#pragma once

#include <vector>

#include "plugins/plant/plant_file.h"

namespace pedicel::plant {

/// How a curve hangs on the others.
struct StemJoint {
  int parent = -1;         ///< curve; -1: it is the root, or reaches nothing
  bool joined = false;     ///< it is the root, or hangs on the parent
  bool foot_first = true;  ///< whether its foot is its first point
  double parent_at = 0.0;  ///< 1, where on the parent
  double distance = 0.0;   ///< m, from its foot to the parent's centre line (or the root)
};

/// How the curves of a plant hang together, one entry a curve: breadth first from the curve whose
/// end is nearest to the root, a curve hangs on the first one that an end of it is nearer to than
/// `connect`. The rule of plant_graph.h on curves in place of nodes, for editing: an unfinished
/// plant has a tree, too. Curves with fewer than two points are not joined.
std::vector<StemJoint> stem_tree(const PlantFile& plant);

/// The curves that hang on one, directly or not, in the order of the tree; without itself.
std::vector<int> branches_of(const std::vector<StemJoint>& tree, int curve);

}  // namespace pedicel::plant
