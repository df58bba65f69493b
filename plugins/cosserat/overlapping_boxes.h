#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/frames.h"
#include "cosserat/parted_loop.h"

namespace pedicel::cosserat {

/// Pairs of boxes that overlap, found by sweeping along the longest axis of them all, in single
/// precision: boxes nearer than some 1e-5 of the size of them all may count as overlapping, too.
/// Does not allocate once warm.
class OverlappingBoxes {
 public:
  /// Replaces `pairs` with all (i, j), i < j, each once, in an order that depends on the boxes
  /// alone. Empty boxes overlap nothing.
  void find(std::span<const Eigen::AlignedBox3d> boxes, std::vector<std::pair<int, int>>& pairs,
            const PartedLoop& loop = {});

 private:
  struct Place {
    unsigned key;  // of the low end along the axis swept
    int box;
  };
  void sort_along(int axis, const Eigen::AlignedBox3d& all,
                  std::span<const Eigen::AlignedBox3d> boxes);
  void sort_by_key();

  std::vector<Place> order_, other_order_;
  // In that order, m from the middle of them all, with a vector's worth beyond the last; the axis
  // swept along is the first.
  std::array<std::vector<float>, 3> low_, high_;
  std::array<std::vector<std::pair<int, int>>, PartedLoop::most_parts> found_;  // by part
};

/// Sorts pairs of numbers in [0, count) ascending, by counting. Does not allocate once warm.
class PairSort {
 public:
  void operator()(std::vector<std::pair<int, int>>& pairs, int count);

 private:
  std::vector<std::pair<int, int>> other_;
  std::vector<int> places_;
};

}  // namespace pedicel::cosserat
