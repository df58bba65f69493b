#include "cosserat/capsules.h"

#include <algorithm>
#include <cstdint>

// Compiled once for each instruction set, as lane_kernels.cpp is.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cosserat/capsules.cpp"
// clang-format off: foreach_target.h includes this file again and must come first.
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// clang-format on

#include "cosserat/lane_math-inl.h"

#ifndef PEDICEL_COSSERAT_CAPSULES_MIDWAY
#define PEDICEL_COSSERAT_CAPSULES_MIDWAY
namespace pedicel::cosserat {
constexpr double midway = 1.0e-4;  // pull towards the middles, relative to the longer axis squared
constexpr std::size_t worth_waking = 256;  // pairs
}  // namespace pedicel::cosserat
#endif

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

using Indices = hn::RebindToSigned<D>;
using IndexVector = hn::Vec<Indices>;

HWY_INLINE V3 gather(const std::array<std::vector<double>, 3>& from, IndexVector at) {
  const D d;
  return {hn::GatherIndex(d, from[0].data(), at), hn::GatherIndex(d, from[1].data(), at),
          hn::GatherIndex(d, from[2].data(), at)};
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

HWY_INLINE IndexVector load_indices(const int* from) {
  return hn::PromoteTo(Indices(), hn::LoadU(hn::Rebind<int, D>(), from));
}

HWY_INLINE V radius(const Capsules& capsules, IndexVector of, V fraction) {
  const V near = hn::GatherIndex(D(), capsules.radius_near.data(), of);
  const V far = hn::GatherIndex(D(), capsules.radius_far.data(), of);
  return hn::MulAdd(fraction, far - near, near);
}

void Measure(const Capsules& capsules, CapsulePairs& pairs, std::size_t first, std::size_t end) {
  const D d;
  for (std::size_t i = first; i < end; i += hn::MaxLanes(d)) {
    const IndexVector a = load_indices(&pairs.a[i]), b = load_indices(&pairs.b[i]);
    const V3 near_a = gather(capsules.near, a), along_a = gather(capsules.far, a) - near_a;
    const V3 near_b = gather(capsules.near, b), along_b = gather(capsules.far, b) - near_b;
    const Fractions at = nearest(near_a - near_b, along_a, along_b);
    const V3 apart = add_scaled(near_a, at.a, along_a) - add_scaled(near_b, at.b, along_b);
    const V gap =
        hn::Sqrt(dot(apart, apart)) - radius(capsules, a, at.a) - radius(capsules, b, at.b);
    hn::StoreU(at.a, d, &pairs.at_a[i]);
    hn::StoreU(at.b, d, &pairs.at_b[i]);
    hn::StoreU(gap, d, &pairs.gap[i]);
  }
}

// Returns how many pairs were looked at: all but those that do not fill a vector.
std::size_t Sift(const CapsulePairs& from, double open, const std::vector<double>& reach,
                 CapsulePairs& kept) {
  const D d;
  const std::size_t width = hn::MaxLanes(d);
  std::size_t i = 0;
  for (; i + width <= from.size(); i += width) {
    const IndexVector a = load_indices(&from.a[i]), b = load_indices(&from.b[i]);
    const V reached = hn::GatherIndex(d, reach.data(), a) + hn::GatherIndex(d, reach.data(), b);
    const M near = hn::LoadU(d, &from.gap[i]) <= set(open) + reached;
    if (hn::AllFalse(d, near)) continue;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, near, bits);
    for (unsigned left = bits[0]; left != 0; left &= left - 1)
      kept.add(from, i + __builtin_ctz(left));
  }
  return i;
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pedicel::cosserat {

HWY_EXPORT(Measure);

HWY_EXPORT(Sift);

// Pairs of the first capsule with itself fill the last vector up.
void measure(const Capsules& capsules, CapsulePairs& pairs, const PartedLoop& loop) {
  const std::size_t count = pairs.size();
  pairs.resize((count + lane_count - 1) / lane_count * lane_count);
  loop.run(count, loop.parts(count, worth_waking), [&](int, std::size_t first, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(Measure)(capsules, pairs, first, end);
  });
  pairs.resize(count);
}

void sift(const CapsulePairs& from, double open, const std::vector<double>& reach,
          CapsulePairs& kept) {
  kept.clear();
  std::size_t i = HWY_DYNAMIC_DISPATCH(Sift)(from, open, reach, kept);
  for (; i < from.size(); ++i)
    if (from.gap[i] <= open + (reach[from.a[i]] + reach[from.b[i]])) kept.add(from, i);
}

void Capsules::resize(std::size_t count) {
  for (int i = 0; i < 3; ++i) {
    near[i].resize(count);
    far[i].resize(count);
  }
  radius_near.resize(count);
  radius_far.resize(count);
}

void CapsulePairs::clear() {
  a.clear();
  b.clear();
  gap.clear();
}

void CapsulePairs::resize(std::size_t count) {
  a.resize(count);
  b.resize(count);
  at_a.resize(count);
  at_b.resize(count);
  gap.resize(count);
}

void CapsulePairs::add(int first, int second) {
  a.push_back(first);
  b.push_back(second);
}

void CapsulePairs::add(const CapsulePairs& from, std::size_t pair) {
  add(from.a[pair], from.b[pair]);
  gap.push_back(from.gap[pair]);
}

void CapsulePairs::append(const CapsulePairs& measured) {
  a.insert(a.end(), measured.a.begin(), measured.a.end());
  b.insert(b.end(), measured.b.begin(), measured.b.end());
  gap.insert(gap.end(), measured.gap.begin(), measured.gap.end());
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
