#include "plugins/cosserat/contact/overlapping_boxes.h"

#include <cmath>
#include <limits>
#include <numeric>

// Compiled once for each instruction set, as lane_kernels.cpp is.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/cosserat/contact/overlapping_boxes.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "plugins/cosserat/lanes/lane_math-inl.h"

#ifndef PEDICEL_COSSERAT_OVERLAPPING_BOXES
#define PEDICEL_COSSERAT_OVERLAPPING_BOXES
namespace pedicel::cosserat {

using Group = OverlappingBoxes::Group;
using Groups = OverlappingBoxes::Groups;
using Boxes = OverlappingBoxes::Boxes;
using Scratch = OverlappingBoxes::Scratch;

constexpr int group_size = OverlappingBoxes::group_size;
constexpr std::size_t most_floats = 16;  // of a vector
constexpr int near = 32;                 // numbers beyond a box's own, a bit each
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Box {
  float low[3], high[3];
};
inline Box box_of(const Group& group, int lane) {
  return {{group.low[0][lane], group.low[1][lane], group.low[2][lane]},
          {group.high[0][lane], group.high[1][lane], group.high[2][lane]}};
}
inline Box box_of(const Boxes& boxes, std::size_t i) {
  return {{boxes.low[0][i], boxes.low[1][i], boxes.low[2][i]},
          {boxes.high[0][i], boxes.high[1][i], boxes.high[2][i]}};
}

// Of a box's pairs with a group, those with greater numbers that may not be left out, a bit each.
inline unsigned looked_for(const Groups& groups, int box, int group) {
  const int first = group * group_size - box - 1;  // the group's, counted from the box's next
  const unsigned left_out = groups.near_left_out[box];
  if (first >= near) return 255;
  if (first >= 0) return 255 & ~(left_out >> first);
  return 255 & ~(left_out << -first) & ~0u << -first;
}

// a < b.
inline bool is_far_left_out(const Groups& groups, int a, int b) {
  const auto first = groups.far_left_out.begin();
  return std::binary_search(first + groups.first_far_left_out[a],
                            first + groups.first_far_left_out[a + 1], std::pair(a, b));
}

inline bool is_left_out(const Groups& groups, int a, int b) {
  if (b - a > near) return is_far_left_out(groups, a, b);
  return groups.near_left_out[a] >> (b - a - 1) & 1;
}

}  // namespace pedicel::cosserat
#endif

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

// Which of a vector's worth of boxes overlap the one; low(k) and high(k) are where the first one's
// coordinates are.
template <class Tag, class Low, class High>
HWY_INLINE hn::Mask<Tag> overlapping(Tag d, const Box& box, const Low& low, const High& high) {
  const auto beside = [&](int k) {
    return hn::And(hn::LoadU(d, low(k)) <= hn::Set(d, box.high[k]),
                   hn::LoadU(d, high(k)) >= hn::Set(d, box.low[k]));
  };
  return hn::And(hn::And(beside(0), beside(1)), beside(2));
}

// What follows writes a vector's worth at a time, whatever of it counts: branches on which boxes
// overlap would be guessed wrong every other time.

// Puts the chosen ones together; returns how many. Compressing in a register and storing all of it
// is fast on every processor, compressing into memory on some is not.
template <class Vector, class Mask, class Tag>
HWY_INLINE std::size_t compress_store(Vector all, Mask chosen, Tag d, int* to) {
  hn::StoreU(hn::Compress(all, chosen), d, to);
  return hn::CountTrue(d, chosen);
}

// first, first + 1, ...: Iota() of a number that is no constant goes through memory.
template <class Tag>
HWY_INLINE hn::Vec<Tag> counted_from(Tag d, int first) {
  return hn::Iota(d, 0) + hn::Set(d, first);
}

// Lists `numbers` of those of the boxes from `first` to `end` that overlap the one, ascending.
// Returns how many.
template <class Numbers>
HWY_INLINE std::size_t list_overlapping(const Box& box, const Boxes& boxes, std::size_t first,
                                        std::size_t end, const Numbers& numbers, int* list) {
  const hn::CappedTag<float, most_floats> d;
  const hn::RebindToSigned<decltype(d)> numbers_tag;
  std::size_t count = 0;
  for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
    const auto found = overlapping(
        d, box, [&](int k) { return &boxes.low[k][i]; }, [&](int k) { return &boxes.high[k][i]; });
    count += compress_store(numbers(numbers_tag, i), hn::RebindMask(numbers_tag, found),
                            numbers_tag, list + count);
  }
  return count;
}

// Lists the groups from the given one on that its box overlaps; returns how many.
HWY_INLINE std::size_t list_groups(const Groups& groups, std::size_t group, Scratch& scratch) {
  const auto own = [](auto d, std::size_t i) { return counted_from(d, static_cast<int>(i)); };
  const std::size_t count = list_overlapping(box_of(groups.around, group), groups.around, group,
                                             groups.boxes.size(), own, scratch.groups.data());
  for (std::size_t place = 0; place < count; ++place) {
    const int other = scratch.groups[place];
    for (int k = 0; k < 3; ++k) {
      scratch.around.low[k][place] = groups.around.low[k][other];
      scratch.around.high[k][place] = groups.around.high[k][other];
    }
  }
  // The last vector's others are empty.
  std::fill_n(&scratch.around.low[0][count], most_floats, infinity);
  return count;
}

// Adds the box's pairs with those of a group that it overlaps, from the place `count` on. Returns
// where the next ones come.
HWY_INLINE std::size_t add_pairs(const Groups& groups, int a, const Box& box, int group,
                                 CapsulePairs& pairs, std::size_t count) {
  const hn::CappedTag<float, group_size> d;
  const hn::RebindToSigned<decltype(d)> numbers_tag;
  const Group& others = groups.boxes[group];
  const unsigned wanted = looked_for(groups, a, group);
  for (std::size_t i = 0; i < group_size; i += hn::Lanes(d)) {
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(wanted >> i)};
    const auto found = hn::And(overlapping(
                                   d, box, [&](int k) { return &others.low[k][i]; },
                                   [&](int k) { return &others.high[k][i]; }),
                               hn::LoadMaskBits(d, bits));
    const int first = group * group_size + static_cast<int>(i);
    hn::StoreU(hn::Set(numbers_tag, a), numbers_tag, &pairs.a[count]);
    count += compress_store(counted_from(numbers_tag, first), hn::RebindMask(numbers_tag, found),
                            numbers_tag, &pairs.b[count]);
  }
  return count;
}

// Takes out those of the pairs from `first` on that are left out.
std::size_t without_far(const Groups& groups, CapsulePairs& pairs, std::size_t first,
                        std::size_t end) {
  std::size_t count = first;
  for (std::size_t i = first; i < end; ++i)
    if (!is_far_left_out(groups, pairs.a[i], pairs.b[i])) pairs.b[count++] = pairs.b[i];
  return count;
}

void Compare(const Groups& groups, std::size_t first, std::size_t end, Scratch& scratch) {
  CapsulePairs& pairs = scratch.pairs;
  pairs.clear();
  scratch.all_met = 0;
  const auto listed = [&](auto d, std::size_t i) { return hn::LoadU(d, &scratch.groups[i]); };
  for (std::size_t group = first / group_size; group * group_size < end; ++group) {
    const std::size_t count = list_groups(groups, group, scratch);
    for (int lane = 0; lane < group_size; ++lane) {
      const int a = static_cast<int>(group) * group_size + lane;
      const Box box = box_of(groups.boxes[group], lane);
      const std::size_t met =
          list_overlapping(box, scratch.around, 0, count, listed, scratch.met.data());
      scratch.all_met += met;
      pairs.make_room(met * group_size);
      std::size_t place = pairs.size();
      for (std::size_t k = 0; k < met; ++k)
        place = add_pairs(groups, a, box, scratch.met[k], pairs, place);
      if (groups.first_far_left_out[a] < groups.first_far_left_out[a + 1])
        place = without_far(groups, pairs, pairs.size(), place);
      pairs.resize(place);
    }
  }
}

void CompareOne(const Groups& groups, int box, Scratch& scratch, CapsulePairs& pairs) {
  const hn::CappedTag<float, group_size> d;
  const Box own = box_of(groups.boxes[box / group_size], box % group_size);
  const std::size_t count = list_overlapping(
      own, groups.around, 0, groups.boxes.size(),
      [](auto tag, std::size_t i) { return counted_from(tag, static_cast<int>(i)); },
      scratch.groups.data());
  for (std::size_t place = 0; place < count; ++place) {
    const Group& others = groups.boxes[scratch.groups[place]];
    for (std::size_t i = 0; i < group_size; i += hn::Lanes(d)) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d,
                        overlapping(
                            d, own, [&](int k) { return &others.low[k][i]; },
                            [&](int k) { return &others.high[k][i]; }),
                        bits);
      for (unsigned left = bits[0]; left != 0; left &= left - 1) {
        const int other =
            scratch.groups[place] * group_size + static_cast<int>(i) + __builtin_ctz(left);
        const auto [a, b] = std::minmax(box, other);
        if (a != b && !is_left_out(groups, a, b)) pairs.add(a, b);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Compare);
HWY_EXPORT(CompareOne);

namespace {

void make_empty(Boxes& boxes, std::size_t room) {
  for (auto& side : boxes.low) side.assign(room, infinity);
  for (auto& side : boxes.high) side.assign(room, -infinity);
}

}  // namespace

void OverlappingBoxes::make_room(Scratch& scratch) const {
  const std::size_t room = groups_.around.low[0].size();
  if (scratch.around.low[0].size() != room) make_empty(scratch.around, room);
  scratch.groups.resize(room);
  scratch.met.resize(room);
}

void OverlappingBoxes::find_with(std::size_t box, CapsulePairs& pairs) {
  make_room(scratch_[0]);
  HWY_DYNAMIC_DISPATCH(CompareOne)(groups_, static_cast<int>(box), scratch_[0], pairs);
}

// The stretches at which the parts begin that had equal shares of the work the last time.
std::array<std::size_t, PartedLoop::most_parts + 1> OverlappingBoxes::share_out(int parts) const {
  std::array<std::size_t, PartedLoop::most_parts + 1> begins{};
  const double all = std::accumulate(work_.begin(), work_.end(), 0.0);
  double before = 0.0;
  int part = 1;
  for (std::size_t stretch = 0; stretch < work_.size(); ++stretch) {
    while (part < parts && before + 0.5 * work_[stretch] > all * part / parts)
      begins[part++] = stretch;
    before += work_[stretch];
  }
  std::fill(begins.begin() + part, begins.end(), work_.size());
  return begins;
}

// Boxes from `first` on that other threads have just set come from their cores' caches: all asked
// for at once, they are not waited for one by one.
void OverlappingBoxes::fetch_from(std::size_t first) const {
  constexpr std::size_t a_line = 64 / sizeof(float);
  for (std::size_t g = first / group_size; g < groups_.boxes.size(); ++g)
    for (std::size_t i = 0; i < sizeof(Group) / sizeof(float); i += a_line)
      __builtin_prefetch(&groups_.boxes[g].low[0][0] + i);
}

void OverlappingBoxes::compare(std::size_t first, std::size_t end, Scratch& scratch) const {
  make_room(scratch);
  HWY_DYNAMIC_DISPATCH(Compare)(groups_, first, end, scratch);
}

void OverlappingBoxes::resize(std::size_t count) {
  count_ = count;
  const std::size_t groups = (count + group_size - 1) / group_size;
  Group empty;
  std::fill_n(&empty.low[0][0], 3 * group_size, infinity);
  std::fill_n(&empty.high[0][0], 3 * group_size, -infinity);
  groups_.boxes.assign(groups, empty);
  work_.assign((count + at_a_time - 1) / at_a_time, with_groups);
  make_empty(groups_.around, groups + most_floats);
  leave_out({});
}

void OverlappingBoxes::leave_out(const std::vector<std::pair<int, int>>& pairs) {
  const std::size_t room = groups_.boxes.size() * group_size;
  groups_.near_left_out.assign(room, 0);
  groups_.far_left_out.clear();
  groups_.first_far_left_out.assign(room + 1, 0);
  for (const auto& [a, b] : pairs) {
    if (b - a <= near) {
      groups_.near_left_out[a] |= 1u << (b - a - 1);
    } else {
      groups_.far_left_out.emplace_back(a, b);
      ++groups_.first_far_left_out[a + 1];
    }
  }
  std::partial_sum(groups_.first_far_left_out.begin(), groups_.first_far_left_out.end(),
                   groups_.first_far_left_out.begin());
}

void OverlappingBoxes::set(std::size_t box, const Vec3& low, const Vec3& high) {
  constexpr float outward = 1.2e-7F;  // of a number: a float's rounding
  const bool finite = std::isfinite((low + high).sum());
  Group& group = groups_.boxes[box / group_size];
  for (int k = 0; k < 3; ++k) {
    const auto below = static_cast<float>(low[k]), above = static_cast<float>(high[k]);
    group.low[k][box % group_size] = finite ? below - outward * std::abs(below) : infinity;
    group.high[k][box % group_size] = finite ? above + outward * std::abs(above) : -infinity;
  }
}

void OverlappingBoxes::close_groups(std::size_t first, std::size_t end) {
  for (std::size_t g = first / group_size; g * group_size < end; ++g)
    for (int k = 0; k < 3; ++k) {
      const Group& group = groups_.boxes[g];
      groups_.around.low[k][g] = *std::min_element(group.low[k], group.low[k] + group_size);
      groups_.around.high[k][g] = *std::max_element(group.high[k], group.high[k] + group_size);
    }
}

}  // namespace pedicel::cosserat
#endif
