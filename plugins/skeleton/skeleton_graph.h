#pragma once

#include <array>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/skeleton/skeleton.h"

namespace pedicel::plant {

/// Places that are joined by edges without a direction that counts.
struct SkeletonGraph {
  struct Edge {
    std::array<int, 2> ends = {0, 0};  ///< indices of places
    std::optional<double> diameter;    ///< m
    SourcePosition where;
  };
  std::string file;                  ///< for errors
  std::vector<SkeletonNode> places;  ///< without parents
  std::vector<Edge> edges;
};

/// The tree that a graph is, parents first. Places at the same coordinates are one, an edge that
/// repeats another is left out, and so are places without an edge (with a warning). The root is the
/// one place from which every edge leads away, or to which every edge leads, where there is just
/// one of these; else the lowest one. An axis goes on to where the longest way begins. Rings and
/// parts that hang together with nothing go to the diagnostics; then the result is empty.
std::vector<SkeletonNode> rooted_tree(const SkeletonGraph& graph, Diagnostics& diagnostics);

}  // namespace pedicel::plant
