// The formula of material_nonlinearity (and of what softens). Included once an instruction set.
#if defined(PEDICEL_LAWS_MATERIAL_NONLINEARITY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_LAWS_MATERIAL_NONLINEARITY_INL_H
#undef PEDICEL_LAWS_MATERIAL_NONLINEARITY_INL_H
#else
#define PEDICEL_LAWS_MATERIAL_NONLINEARITY_INL_H
#endif

#include <limits>

#include "plugins/cosserat/laws/joint_term-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::laws {
namespace HWY_NAMESPACE {

/// Moment = elastic (1 + hardening u) K phi. Below zero it peaks at u = 1/(3 |hardening|), and
/// stays at its peak beyond.
struct material_nonlinearity {
  static constexpr int numbers = 1;  // 1/rad2, hardening

  template <class T>
  static HWY_INLINE Radial<T> radial(T hardening, T u) {
    const T half = number(u, 0.5), one = number(u, 1.0);
    // Beyond its peak a softening law would have a negative slope: the joint snaps, and a step has
    // no least potential any more.
    const auto softens = hardening < number(u, 0.0);
    const T peak =
        choose(softens, one / (number(u, -3.0) * smaller(hardening, number(u, -1.0e-300))),
               number(u, std::numeric_limits<double>::infinity()));
    const auto beyond = u > peak;
    // All lanes compute both ways. Those within get ones, since infinity less infinity is no
    // number.
    const T safe_peak = choose(beyond, peak, one), safe_u = choose(beyond, u, one);
    const T bend = root(safe_peak), flat = number(u, 2.0 / 3.0) * bend / root(safe_u);
    const T flat_energy =
        number(u, 5.0 / 12.0) * safe_peak + number(u, 2.0 / 3.0) * bend * (root(safe_u) - bend);
    return {choose(beyond, flat, mul_add(hardening, u, one)),
            choose(beyond, negative(flat) / safe_u, hardening + hardening),
            choose(beyond, flat_energy, half * u + number(u, 0.25) * hardening * u * u)};
  }

  template <class T>
  static HWY_INLINE void add(const T* numbers, const BentJoint<T>& joint, BendTerms<T>& out) {
    // By the energy of the bend, so that both axes harden together.
    const T u = bend_measure(joint, joint.phi1, joint.phi2);
    Radial<T> beyond = radial(numbers[0], u);
    beyond.g = beyond.g - number(u, 1.0);  // what is linear of it is there
    beyond.energy = beyond.energy - number(u, 0.5) * u;
    add_radial(joint, joint.elastic, joint.phi1, joint.phi2, beyond, out);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::laws
HWY_AFTER_NAMESPACE();

#endif
