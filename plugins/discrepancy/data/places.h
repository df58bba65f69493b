#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// A curve of the plant with the markers on it, in their order away from the root or the junction.
struct MarkerChain {
  int curve = 0;             ///< index in the plant file
  std::vector<int> markers;  ///< by experiment.markers
  std::vector<double> arc;   ///< m from the chain's foot, of each marker
  Vec3 foot = Vec3::Zero();  ///< m, as drawn: the root, or where the branch is joined
  double length = 0.0;       ///< m
  bool rooted = false;       ///< its foot is the plant's clamped root
  int parent = -1;           ///< chain that carries it; -1 for one at the root
  double parent_arc = 0.0;   ///< m along the parent from the parent's foot
};

/// One chain a curve of the plant, in their order; a chain may have no markers.
std::vector<MarkerChain> chains_of(const Experiment& experiment);

/// m, W, as drawn.
Vec3 drawn_point(const plant::PlantCurve& curve, double at);
double drawn_length(const plant::PlantCurve& curve);

}  // namespace pedicel::discrepancy
