// The formula of asymmetry. Included once an instruction set.
#if defined(PEDICEL_LAWS_ASYMMETRY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_LAWS_ASYMMETRY_INL_H
#undef PEDICEL_LAWS_ASYMMETRY_INL_H
#else
#define PEDICEL_LAWS_ASYMMETRY_INL_H
#endif

#include "plugins/cosserat/laws/joint_term-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::laws {
namespace HWY_NAMESPACE {

/// A joint that is stiffer when it bends one way about an axis a than the other way. With x =
/// a.phi, p = k0 times the joint's length and K the joint's stiffness about a,
///
///   moment  m(x) = K c x^2 / sqrt(p^2 + x^2)
///   energy  K c [x sqrt(p^2 + x^2) - p^2 asinh(x/p)] / 2
///   slope   m'(x) = K c (2 r - r^3), r = x / sqrt(p^2 + x^2), at most 1.09 K |c|
///
/// beside the linear moment K x: with |c| <= 0.9 the sum always grows with x. K is the stiffness of
/// a joint that is bent by a moment about a alone, 1 / (a.K^-1 a), so that this holds for two
/// unequal bending stiffnesses, too. Where the stem turns along a, the effect fades.
struct asymmetry {
  static constexpr int numbers = 4;  // 1, coefficient c; 1, a about axes 1 and 2; rad, p

  template <class T>
  static HWY_INLINE void add(const T* numbers, const BentJoint<T>& joint, BendTerms<T>& out) {
    const T c = numbers[0], a1 = numbers[1], a2 = numbers[2];
    const T p = larger(numbers[3], number(c, 1.0e-30));
    const T square = a1 * a1 + a2 * a2;
    // joint.k times the share that is elastic, along a / |a|; 0 where a has no part in the section.
    const T stiffness = joint.elastic * square * joint.k1 * joint.k2 /
                        mul_add(a1 * a1, joint.k2, mul_add(a2 * a2, joint.k1, number(c, 1.0e-300)));
    const T x = mul_add(a1, joint.phi1, a2 * joint.phi2);
    const T s = root(mul_add(p, p, x * x)), r = x / s;
    const T k = stiffness * c, moment = k * x * r;
    out.moment1 = mul_add(moment, a1, out.moment1);
    out.moment2 = mul_add(moment, a2, out.moment2);
    out.energy = mul_add(number(c, 0.5) * k, x * s - p * p * inverse_sinh(x / p), out.energy);
    // The steepest slope bounds the energy from above.
    const T slope = k * (number(c, 2.0) - r * r) * r;
    const T most = number(c, 1.0887) * stiffness * magnitude(c) * square;
    out.secant1 = out.secant1 + most;
    out.secant2 = out.secant2 + most;
    out.tangent11 = out.tangent11 + slope * a1 * a1 - most;
    out.tangent22 = out.tangent22 + slope * a2 * a2 - most;
    out.tangent12 = out.tangent12 + slope * a1 * a2;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::laws
HWY_AFTER_NAMESPACE();

#endif
