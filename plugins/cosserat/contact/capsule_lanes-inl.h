// Capsules eight at a time: their numbers as lanes. Included once an instruction set, which is why
// it has no ordinary guard.
#if defined(PEDICEL_COSSERAT_CAPSULE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_CAPSULE_LANES_INL_H
#undef PEDICEL_COSSERAT_CAPSULE_LANES_INL_H
#else
#define PEDICEL_COSSERAT_CAPSULE_LANES_INL_H
#endif

#include "plugins/cosserat/contact/capsules.h"
#include "plugins/cosserat/lanes/lane_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

constexpr int width = static_cast<int>(hn::MaxLanes(D()));
constexpr int fields = sizeof(Capsule) / sizeof(double);

// Makes lane j of vector i what was lane i of vector j.
HWY_INLINE void transpose([[maybe_unused]] V* rows) {
#if HWY_TARGET != HWY_SCALAR
#pragma GCC unroll 8
  for (int i = 0; i < width; i += 2) {
    const V a = rows[i], b = rows[i + 1];
    rows[i] = hn::InterleaveLower(D(), a, b);
    rows[i + 1] = hn::InterleaveUpper(D(), a, b);
  }
  if constexpr (width >= 4) {  // pairs of lanes
#pragma GCC unroll 8
    for (int i = 0; i < width; i += i % 4 == 1 ? 3 : 1) {
      const V a = rows[i], b = rows[i + 2];
      rows[i] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a);
      rows[i + 2] = hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a));
    }
  }
  if constexpr (width >= 8) {  // halves
#pragma GCC unroll 8
    for (int i = 0; i < width / 2; ++i) {
      const V a = rows[i], b = rows[i + 4];
      rows[i] = hn::ConcatLowerLower(D(), b, a);
      rows[i + 4] = hn::ConcatUpperUpper(D(), b, a);
    }
  }
#endif
}

struct Ends {
  V3 near;
  V radius_near;
  V3 far;
  V radius_far;
};

// The numbers of a vector's worth of capsules, capsule k's being the eight that rows(k, place)
// gives a vector of, from the given one of them on.
template <class Rows>
HWY_INLINE Ends transposed(const Rows& rows) {
  V all[fields];
#pragma GCC unroll 8
  for (int place = 0; place < fields; place += width) {
#pragma GCC unroll 8
    for (int k = 0; k < width; ++k) all[place + k] = rows(k, place);
    transpose(all + place);
  }
  return {{all[0], all[1], all[2]}, all[3], {all[4], all[5], all[6]}, all[7]};
}

HWY_INLINE V load_row(const Capsule& capsule, int place) {
  return load(capsule.near + place);
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
