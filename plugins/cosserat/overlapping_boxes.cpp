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
using Sides = std::array<std::vector<float>, 3>;
using Pairs = std::vector<std::pair<int, int>>;
constexpr std::size_t most_floats = 16;  // of a vector
}  // namespace pedicel::cosserat
#endif

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

// Compares each box with those that begin before it ends, several at a time: their places in order.
void Sweep(const Sides& low, const Sides& high, std::size_t first, std::size_t last, Pairs& pairs) {
  const hn::CappedTag<float, most_floats> d;
  const std::size_t width = hn::Lanes(d);
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i) {
    const auto low1 = hn::Set(d, low[1][i]), high1 = hn::Set(d, high[1][i]);
    const auto low2 = hn::Set(d, low[2][i]), high2 = hn::Set(d, high[2][i]);
    const auto end = hn::Set(d, high[0][i]);
    for (std::size_t j = i + 1; low[0][j] <= high[0][i]; j += width) {
      const auto at = [&](const std::vector<float>& side) { return hn::LoadU(d, &side[j]); };
      const auto beside =
          hn::And(hn::And(at(low[1]) <= high1, at(high[1]) >= low1), at(low[0]) <= end);
      const auto overlap = hn::And(hn::And(at(low[2]) <= high2, at(high[2]) >= low2), beside);
      if (hn::AllFalse(d, overlap)) continue;
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, overlap, bits);
      if (count + most_floats > pairs.size()) pairs.resize(2 * count + 64 * most_floats);
      for (unsigned left = bits[0] | bits[1] << 8; left != 0; left &= left - 1)
        pairs[count++] = {static_cast<int>(i), static_cast<int>(j) + __builtin_ctz(left)};
    }
  }
  pairs.resize(count);
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Sweep);

void OverlappingBoxes::find(std::span<const Eigen::AlignedBox3d> boxes, Pairs& pairs) {
  pairs.clear();
  find(boxes, {},
       [&](int, const Pairs& some) { pairs.insert(pairs.end(), some.begin(), some.end()); });
}

// Returns how many boxes are not empty.
std::size_t OverlappingBoxes::sort(std::span<const Eigen::AlignedBox3d> boxes) {
  order_.clear();
  Eigen::AlignedBox3d all;
  for (const Eigen::AlignedBox3d& box : boxes)
    if (!box.isEmpty()) all.extend(box);
  if (all.isEmpty()) return 0;
  int axis = 0;
  all.sizes().maxCoeff(&axis);
  sort_along(axis, all, boxes);
  return order_.size();
}

void OverlappingBoxes::sweep(std::size_t first, std::size_t end, Pairs& pairs) const {
  HWY_DYNAMIC_DISPATCH(Sweep)(low_, high_, first, end, pairs);
  for (auto& [i, j] : pairs) {
    const int a = order_[i].box, b = order_[j].box;
    i = std::min(a, b);
    j = std::max(a, b);
  }
}

// By a key of 16 bits; the low end swept along is that of the key, at or below the box's.
void OverlappingBoxes::sort_along(int axis, const Eigen::AlignedBox3d& all,
                                  std::span<const Eigen::AlignedBox3d> boxes) {
  constexpr double keys = 65535.0;
  const double start = all.min()[axis], step = all.sizes()[axis] / keys;
  const double per_step = step > 0.0 ? 1.0 / step : 0.0;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    if (!boxes[i].isEmpty())
      order_.push_back({static_cast<unsigned>((boxes[i].min()[axis] - start) * per_step), i});
  sort_by_key();
  const Vec3 middle = all.center();
  const double rounding = 2.0e-6 * all.sizes().maxCoeff();  // float's is 6e-8 of half the size
  for (int k = 0; k < 3; ++k) {
    // What a vector holds beyond the last box begins after every other.
    low_[k].assign(order_.size() + most_floats, std::numeric_limits<float>::infinity());
    high_[k].assign(order_.size() + most_floats, std::numeric_limits<float>::infinity());
    const int from = (axis + k) % 3;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Eigen::AlignedBox3d& box = boxes[order_[i].box];
      const double low = k == 0 ? start + order_[i].key * step : box.min()[from];
      low_[k][i] = static_cast<float>(low - middle[from] - rounding);
      high_[k][i] = static_cast<float>(box.max()[from] - middle[from] + rounding);
    }
  }
}

// Two passes of counting, eight bits each.
void OverlappingBoxes::sort_by_key() {
  other_order_.resize(order_.size());
  for (const int shift : {0, 8}) {
    std::array<int, 257> places{};
    for (const Place& place : order_) ++places[(place.key >> shift & 255) + 1];
    for (int i = 0; i < 256; ++i) places[i + 1] += places[i];
    for (const Place& place : order_) other_order_[places[place.key >> shift & 255]++] = place;
    order_.swap(other_order_);
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
