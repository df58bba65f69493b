// Elements of a RodState as lanes. Included once an instruction set, which is why it has no
// ordinary guard.
#if defined(PEDICEL_COSSERAT_STATE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_COSSERAT_STATE_LANES_INL_H
#undef PEDICEL_COSSERAT_STATE_LANES_INL_H
#else
#define PEDICEL_COSSERAT_STATE_LANES_INL_H
#endif

#include <cstdint>

#include "plugins/cosserat/lanes/lane_math-inl.h"
#include "plugins/cosserat/model/rod_state.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::cosserat {
namespace HWY_NAMESPACE {

struct GatheredPose {
  V3 position;  // m, W, of the child node
  M3 rotation;  // E to W
};

// Of a vector's worth of elements.
HWY_INLINE GatheredPose gather_pose(const RodState& state, const std::int64_t* elements) {
  const auto element = hn::Load(hn::Rebind<std::int64_t, D>(), elements);
  const auto four = hn::ShiftLeft<2>(element), three = hn::Sub(four, element);
  const double* p = state.position.data()->data();
  const double* q = state.orientation.data()->coeffs().data();
  const auto gather = [](const double* from, auto at) { return hn::GatherIndex(D(), from, at); };
  return {{gather(p, three), gather(p + 1, three), gather(p + 2, three)},
          matrix({gather(q, four), gather(q + 1, four), gather(q + 2, four), gather(q + 3, four)})};
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::cosserat
HWY_AFTER_NAMESPACE();

#endif
