// The slider of internal_friction and yield. Included once an instruction set.
#if defined(PEDICEL_LAWS_INTERNAL_FRICTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_LAWS_INTERNAL_FRICTION_INL_H
#undef PEDICEL_LAWS_INTERNAL_FRICTION_INL_H
#else
#define PEDICEL_LAWS_INTERNAL_FRICTION_INL_H
#endif

#include "plugins/cosserat/laws/joint_term-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::laws {
namespace HWY_NAMESPACE {

/// A spring in series with a slider (Jenkins element) that slips where sqrt(u) passes `reach`: the
/// moment grows with the bend up to there, and stays.
template <class T>
HWY_INLINE Radial<T> slip(T reach, T u) {
  // Huber's potential in the bend: quadratic up to the limit, and straight beyond.
  const T bend = root(u);
  const auto slips = bend > reach;
  // Lanes that do not slip compute along. They get numbers that no root or division trips over.
  const T safe_u = choose(slips, u, number(u, 1.0));
  const T safe_reach = choose(slips, reach, number(u, 1.0));
  const T g = choose(slips, safe_reach / root(safe_u), number(u, 1.0));
  return {g, choose(slips, negative(g) / safe_u, number(u, 0.0)),
          choose(slips, mul_add(safe_reach, bend, number(u, -0.5) * safe_reach * safe_reach),
                 number(u, 0.5) * u)};
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::laws
HWY_AFTER_NAMESPACE();

#endif
