#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/frames.h"
#include "cosserat/parted_loop.h"

namespace pedicel::cosserat {

/// Pairs of boxes that overlap, found by sweeping along the longest axis of them all. Does not
/// allocate once warm.
class OverlappingBoxes {
 public:
  /// Replaces `pairs` with all (i, j), i < j, each once, in an order that depends on the boxes
  /// alone. Empty boxes overlap nothing.
  void find(std::span<const Eigen::AlignedBox3d> boxes, std::vector<std::pair<int, int>>& pairs,
            const PartedLoop& loop = {});

 private:
  void sort_along(int axis, std::span<const Eigen::AlignedBox3d> boxes);

  std::vector<std::pair<double, int>> order_;  // low end along the axis swept, box
  // In that order, with a vector's worth beyond the last; the axis swept along is the first.
  std::array<std::vector<double>, 3> low_, high_;
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
