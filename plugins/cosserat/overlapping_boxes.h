#pragma once

#include <algorithm>
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
  void find(std::span<const Eigen::AlignedBox3d> boxes, std::vector<std::pair<int, int>>& pairs);

  /// The same in parts, perhaps at once: take(part, pairs) for some of the pairs at a time, which
  /// then are still in a core's cache. Returns the number of parts. The pairs of part after part
  /// are in an order that depends on the boxes alone, however many parts there are.
  template <class Take>
  int find(std::span<const Eigen::AlignedBox3d> boxes, const PartedLoop& loop, const Take& take) {
    const std::size_t count = sort(boxes);
    const int parts = loop.parts(count, worth_waking, 2);
    loop.run(count, parts, [&](int part, std::size_t first, std::size_t end) {
      for (; first < end; first += at_a_time) {
        sweep(first, std::min(end, first + at_a_time), found_[part]);
        take(part, found_[part]);
      }
    });
    return parts;
  }

 private:
  static constexpr std::size_t worth_waking = 128, at_a_time = 32;  // boxes

  struct Place {
    unsigned key;  // of the low end along the axis swept
    int box;
  };
  std::size_t sort(std::span<const Eigen::AlignedBox3d> boxes);
  void sweep(std::size_t first, std::size_t end, std::vector<std::pair<int, int>>& pairs) const;
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
