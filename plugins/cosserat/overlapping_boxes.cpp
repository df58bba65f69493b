#include "cosserat/overlapping_boxes.h"

#include <algorithm>
#include <limits>

// Compiled once for each instruction set, as lane_kernels.cpp is.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cosserat/overlapping_boxes.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "cosserat/lane_math-inl.h"

#ifndef PEDICEL_COSSERAT_OVERLAPPING_BOXES
#define PEDICEL_COSSERAT_OVERLAPPING_BOXES
namespace pedicel::cosserat {
using Sides = std::array<std::vector<double>, 3>;
using Pairs = std::vector<std::pair<int, int>>;
using Order = std::vector<std::pair<double, int>>;
}  // namespace pedicel::cosserat
#endif

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

// Compares each box with those that begin before it ends, several at a time.
void Sweep(const Order& order, const Sides& low, const Sides& high, std::size_t first,
           std::size_t last, Pairs& pairs) {
  const D d;
  const std::size_t width = hn::MaxLanes(d);
  for (std::size_t i = first; i < last; ++i) {
    const V end = set(high[0][i]);
    const V low1 = set(low[1][i]), high1 = set(high[1][i]);
    const V low2 = set(low[2][i]), high2 = set(high[2][i]);
    for (std::size_t j = i + 1; j < order.size() && low[0][j] <= high[0][i]; j += width) {
      const auto at = [&](const std::vector<double>& side) { return hn::LoadU(d, &side[j]); };
      const M beside =
          hn::And(hn::And(at(low[1]) <= high1, at(high[1]) >= low1), at(low[0]) <= end);
      const M overlap = hn::And(hn::And(at(low[2]) <= high2, at(high[2]) >= low2), beside);
      if (hn::AllFalse(d, overlap)) continue;
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, overlap, bits);
      for (unsigned left = bits[0]; left != 0; left &= left - 1) {
        const int a = order[i].second, b = order[j + __builtin_ctz(left)].second;
        pairs.emplace_back(std::min(a, b), std::max(a, b));
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Sweep);

void OverlappingBoxes::find(std::span<const Eigen::AlignedBox3d> boxes, Pairs& pairs,
                            const PartedLoop& loop) {
  pairs.clear();
  Eigen::AlignedBox3d all;
  for (const Eigen::AlignedBox3d& box : boxes)
    if (!box.isEmpty()) all.extend(box);
  if (all.isEmpty()) return;
  int axis = 0;
  all.sizes().maxCoeff(&axis);
  sort_along(axis, boxes);
  const int parts = loop.parts(order_.size(), 128);
  loop.run(order_.size(), parts, [&](int part, std::size_t first, std::size_t end) {
    found_[part].clear();
    HWY_DYNAMIC_DISPATCH(Sweep)(order_, low_, high_, first, end, found_[part]);
  });
  for (int part = 0; part < parts; ++part)
    pairs.insert(pairs.end(), found_[part].begin(), found_[part].end());
}

void OverlappingBoxes::sort_along(int axis, std::span<const Eigen::AlignedBox3d> boxes) {
  order_.clear();
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    if (!boxes[i].isEmpty()) order_.emplace_back(boxes[i].min()[axis], i);
  std::sort(order_.begin(), order_.end());
  for (int k = 0; k < 3; ++k) {
    // What a vector holds beyond the last box begins after every other.
    low_[k].assign(order_.size() + lane_count, std::numeric_limits<double>::infinity());
    high_[k].assign(order_.size() + lane_count, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      low_[k][i] = boxes[order_[i].second].min()[(axis + k) % 3];
      high_[k][i] = boxes[order_[i].second].max()[(axis + k) % 3];
    }
  }
}

void PairSort::operator()(Pairs& pairs, int count) {
  other_.resize(pairs.size());
  const auto pass = [&](const Pairs& from, Pairs& to, auto number) {
    places_.assign(count + 1, 0);
    for (const auto& pair : from) ++places_[number(pair) + 1];
    for (int i = 0; i < count; ++i) places_[i + 1] += places_[i];
    for (const auto& pair : from) to[places_[number(pair)]++] = pair;
  };
  pass(pairs, other_, [](const auto& pair) { return pair.second; });
  pass(other_, pairs, [](const auto& pair) { return pair.first; });
}

}  // namespace pedicel::cosserat
#endif
