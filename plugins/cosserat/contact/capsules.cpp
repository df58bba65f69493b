#include "plugins/cosserat/contact/capsules.h"

#include <algorithm>
#include <cstdint>

// Compiled once for each instruction set, as lane_kernels.cpp is.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/cosserat/contact/capsules.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "plugins/cosserat/contact/capsule_lanes-inl.h"

#ifndef PEDICEL_COSSERAT_CAPSULES_MIDWAY
#define PEDICEL_COSSERAT_CAPSULES_MIDWAY
namespace pedicel::cosserat {
constexpr double midway = 1.0e-4;  // pull towards the middles, relative to the longer axis squared
}  // namespace pedicel::cosserat
#endif

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

HWY_INLINE Ends gather(const Capsules& capsules, const int* of) {
  return transposed([&](int k, int place) { return load_row(capsules[of[k]], place); });
}

HWY_INLINE V unit_clamped(V x) {
  return hn::Min(hn::Max(x, set(0.0)), set(1.0));
}

struct Fractions {
  V a, b;
};

// The same steps as nearest_fractions(), without branches.
HWY_INLINE Fractions nearest(const V3& between, const V3& along_a, const V3& along_b) {
  const V aa = dot(along_a, along_a), bb = dot(along_b, along_b), ab = dot(along_a, along_b);
  const V pull = hn::MulAdd(set(midway), hn::Max(aa, bb), set(1.0e-18));
  const V left_s = aa + pull, left_t = bb + pull;
  const V right_s = set(0.5) * pull - dot(along_a, between);
  const V right_t = set(0.5) * pull + dot(along_b, between);
  const V determinant = left_s * left_t - ab * ab;
  const V s = (right_s * left_t + ab * right_t) / determinant;
  const V t = (right_t * left_s + ab * right_s) / determinant;
  const V zero = set(0.0), one = set(1.0);
  const M inside = hn::And(hn::And(s >= zero, s <= one), hn::And(t >= zero, t <= one));

  Fractions best{zero, zero};
  V least = set(1.0e300);
  const auto offer = [&](V a, V b) {
    const V cost =
        a * (set(0.5) * left_s * a - right_s) + b * (set(0.5) * left_t * b - right_t) - ab * a * b;
    const M better = cost < least;
    least = hn::IfThenElse(better, cost, least);
    best.a = hn::IfThenElse(better, a, best.a);
    best.b = hn::IfThenElse(better, b, best.b);
  };
  offer(zero, unit_clamped(right_t / left_t));
  offer(one, unit_clamped((right_t + ab) / left_t));
  offer(unit_clamped(right_s / left_s), zero);
  offer(unit_clamped((right_s + ab) / left_s), one);
  return {hn::IfThenElse(inside, s, best.a), hn::IfThenElse(inside, t, best.b)};
}

HWY_INLINE V radius(const Ends& of, V fraction) {
  return hn::MulAdd(fraction, of.radius_far - of.radius_near, of.radius_near);
}

void Measure(const Capsules& capsules, CapsulePairs& pairs) {
  const D d;
  for (std::size_t i = 0; i < pairs.size(); i += width) {
    const Ends a = gather(capsules, &pairs.a[i]), b = gather(capsules, &pairs.b[i]);
    const V3 along_a = a.far - a.near, along_b = b.far - b.near;
    const Fractions at = nearest(a.near - b.near, along_a, along_b);
    const V3 apart = add_scaled(a.near, at.a, along_a) - add_scaled(b.near, at.b, along_b);
    const V gap = hn::Sqrt(dot(apart, apart)) - radius(a, at.a) - radius(b, at.b);
    hn::StoreU(at.a, d, &pairs.at_a[i]);
    hn::StoreU(at.b, d, &pairs.at_b[i]);
    hn::StoreU(gap, d, &pairs.gap[i]);
  }
}

using Ints = hn::Rebind<int, D>;
using Floats = hn::Rebind<float, D>;

HWY_INLINE V look_up(const std::vector<float>& values, const int* at) {
  return hn::PromoteTo(D(), hn::GatherIndex(Floats(), values.data(), hn::LoadU(Ints(), at)));
}

// Of the pairs i, i + 1, ..., those before `end`.
HWY_INLINE M before(std::size_t i, std::size_t end) {
  return hn::FirstN(D(), std::min<std::size_t>(end - i, width));
}

// The lanes chosen, one bit each.
HWY_INLINE unsigned bits_of(M mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(D(), mask, bits);
  return bits[0];
}

// Copies the chosen ones of the pairs from i on to the place `to`, which may be i.
HWY_INLINE std::size_t copy_chosen(const CapsulePairs& from, std::size_t i, M chosen,
                                   CapsulePairs& kept, std::size_t to) {
  for (unsigned left = bits_of(chosen); left != 0; left &= left - 1, ++to) {
    const std::size_t pair = i + __builtin_ctz(left);
    kept.a[to] = from.a[pair];
    kept.b[to] = from.b[pair];
    kept.gap[to] = from.gap[pair];
    kept.closing[to] = from.closing[pair];
  }
  return to;
}

HWY_INLINE V sum_at(const std::vector<float>& reach, const int* a, const int* b) {
  return look_up(reach, a) + look_up(reach, b);
}

void Sift(const CapsulePairs& from, std::size_t first, std::size_t end, double open, double steps,
          const std::vector<float>& reach, CapsulePairs& kept) {
  std::size_t count = kept.size();
  for (std::size_t i = first; i < end; i += width) {
    const V closing = hn::PromoteTo(D(), hn::LoadU(Floats(), &from.closing[i]));
    const V most =
        hn::MulAdd(set(steps), closing, set(open)) + sum_at(reach, &from.a[i], &from.b[i]);
    const M near = hn::LoadU(D(), &from.gap[i]) <= most;
    count = copy_chosen(from, i, hn::And(near, before(i, end)), kept, count);
  }
  kept.resize(count);
}

HWY_INLINE V length(const V3& v) {
  return hn::Sqrt(dot(v, v));
}

// Half of each capsule's turn in addition to what the middles do.
HWY_INLINE V moved_apart(const CapsuleMotion& motion, const int* a, const int* b) {
  const Ends to_a = gather(motion.now, a), from_a = gather(motion.start, a);
  const Ends to_b = gather(motion.now, b), from_b = gather(motion.start, b);
  const V3 near_a = to_a.near - from_a.near, far_a = to_a.far - from_a.far;
  const V3 near_b = to_b.near - from_b.near, far_b = to_b.far - from_b.far;
  const V turned = length(near_a - far_a) + length(near_b - far_b);
  return hn::Min(set(0.5) * (length(near_a + far_a - near_b - far_b) + turned),
                 set(2.0 * motion.most));
}

void CollectComing(const CapsuleMotion& motion, double open, double steps,
                   const std::vector<float>& reach, CapsulePairs& pairs, CapsulePairs& kept) {
  for (std::size_t i = 0; i < pairs.size(); i += width) {
    const V closing = moved_apart(motion, &pairs.a[i], &pairs.b[i]);
    hn::StoreU(hn::DemoteTo(Floats(), closing), Floats(), &pairs.closing[i]);
  }
  Sift(pairs, 0, pairs.size(), open, steps, reach, kept);
}

void KeepMeeting(const CapsuleMotion& motion, double open, double times,
                 const std::vector<float>& reach, CapsulePairs& pairs) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.size(); i += width) {
    const int *a = &pairs.a[i], *b = &pairs.b[i];
    const V most = set(open) + set(times) * sum_at(reach, a, b) + moved_apart(motion, a, b);
    const M near = hn::LoadU(D(), &pairs.gap[i]) <= most;
    count = copy_chosen(pairs, i, hn::And(near, before(i, pairs.size())), pairs, count);
  }
  pairs.resize(count);
}

std::size_t ListMeeting(const CapsuleMotion& motion, double open, const CapsulePairs& pairs,
                        std::vector<int>& which) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.size(); i += width) {
    const V most = set(open) + moved_apart(motion, &pairs.a[i], &pairs.b[i]);
    const M near = hn::And(hn::LoadU(D(), &pairs.gap[i]) <= most, before(i, pairs.size()));
    for (unsigned left = bits_of(near); left != 0; left &= left - 1)
      which[count++] = static_cast<int>(i) + __builtin_ctz(left);
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Measure);
HWY_EXPORT(Sift);
HWY_EXPORT(CollectComing);
HWY_EXPORT(KeepMeeting);
HWY_EXPORT(ListMeeting);

void measure(const Capsules& capsules, CapsulePairs& pairs) {
  pairs.make_places();
  HWY_DYNAMIC_DISPATCH(Measure)(capsules, pairs);
}

void collect_coming(const CapsuleMotion& motion, double open, double steps,
                    const std::vector<float>& reach, CapsulePairs& pairs, CapsulePairs& kept) {
  kept.make_room(pairs.size());
  HWY_DYNAMIC_DISPATCH(CollectComing)(motion, open, steps, reach, pairs, kept);
}

void sift(const CapsulePairs& from, std::size_t first, std::size_t end, double open, double steps,
          const std::vector<float>& reach, CapsulePairs& kept) {
  kept.make_room(end - first);
  HWY_DYNAMIC_DISPATCH(Sift)(from, first, end, open, steps, reach, kept);
}

void keep_meeting(const CapsuleMotion& motion, double open, double times,
                  const std::vector<float>& reach, CapsulePairs& pairs) {
  HWY_DYNAMIC_DISPATCH(KeepMeeting)(motion, open, times, reach, pairs);
}

std::size_t list_meeting(const CapsuleMotion& motion, double open, const CapsulePairs& pairs,
                         std::vector<int>& which) {
  if (which.size() < pairs.size()) which.resize(2 * pairs.size());
  return HWY_DYNAMIC_DISPATCH(ListMeeting)(motion, open, pairs, which);
}

// Pairs of the first capsule with itself fill the last vector up.
void CapsulePairs::make_places() {
  make_room(0);
  std::fill_n(a.begin() + static_cast<long>(count_), lane_count, 0);
  std::fill_n(b.begin() + static_cast<long>(count_), lane_count, 0);
  at_a.resize(gap.size());
  at_b.resize(gap.size());
}

// The numbers beyond the last pair are indices of capsules, too.
void CapsulePairs::grow(std::size_t room) {
  a.resize(room);
  b.resize(room);
  gap.resize(room);
  closing.resize(room);
}

NearestFractions nearest_fractions(const Vec3& start_a, const Vec3& along_a, const Vec3& start_b,
                                   const Vec3& along_b) {
  const double aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
  const double pull = midway * std::max(aa, bb) + 1.0e-18;
  const Vec3 between = start_a - start_b;
  // Setting the derivatives by s and t to zero:
  //   (aa + pull) s - ab t = right_s,   (bb + pull) t - ab s = right_t
  const double left_s = aa + pull, left_t = bb + pull;
  const double right_s = 0.5 * pull - along_a.dot(between);
  const double right_t = 0.5 * pull + along_b.dot(between);
  const double determinant = left_s * left_t - ab * ab;
  const double s = (right_s * left_t + ab * right_t) / determinant;
  const double t = (right_t * left_s + ab * right_s) / determinant;
  if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) return {s, t};

  // The minimum lies on the square's edge.
  const auto best_s = [&](double fixed) {
    return std::clamp((right_s + ab * fixed) / left_s, 0.0, 1.0);
  };
  const auto best_t = [&](double fixed) {
    return std::clamp((right_t + ab * fixed) / left_t, 0.0, 1.0);
  };
  const NearestFractions edges[] = {
      {0.0, best_t(0.0)}, {1.0, best_t(1.0)}, {best_s(0.0), 0.0}, {best_s(1.0), 1.0}};
  const auto cost = [&](const NearestFractions& f) {
    return f.a * (0.5 * left_s * f.a - right_s) + f.b * (0.5 * left_t * f.b - right_t) -
           ab * f.a * f.b;
  };
  return *std::min_element(std::begin(edges), std::end(edges),
                           [&](const auto& x, const auto& y) { return cost(x) < cost(y); });
}

}  // namespace pedicel::cosserat
#endif
