// What formulas of joint laws are written in, for one joint (double) and for eight side by side
// (lanes). Included once an instruction set, which is why it has no ordinary guard.
#if defined(PEDICEL_LAWS_JOINT_TERM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_LAWS_JOINT_TERM_INL_H
#undef PEDICEL_LAWS_JOINT_TERM_INL_H
#else
#define PEDICEL_LAWS_JOINT_TERM_INL_H
#endif

#include <algorithm>
#include <cmath>

#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::laws {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

/// A number as `like` is one: a double, or the same in all lanes.
HWY_INLINE double number(double /*like*/, double x) {
  return x;
}
HWY_INLINE V number(V /*like*/, double x) {
  return hn::Set(D(), x);
}
HWY_INLINE double root(double x) {
  return std::sqrt(x);
}
HWY_INLINE V root(V x) {
  return hn::Sqrt(x);
}
HWY_INLINE double negative(double x) {
  return -x;
}
HWY_INLINE V negative(V x) {
  return hn::Neg(x);
}
HWY_INLINE double smaller(double a, double b) {
  return std::min(a, b);
}
HWY_INLINE V smaller(V a, V b) {
  return hn::Min(a, b);
}
HWY_INLINE double larger(double a, double b) {
  return std::max(a, b);
}
HWY_INLINE V larger(V a, V b) {
  return hn::Max(a, b);
}
HWY_INLINE double magnitude(double x) {
  return std::abs(x);
}
HWY_INLINE V magnitude(V x) {
  return hn::Abs(x);
}
HWY_INLINE double inverse_sinh(double x) {
  return std::asinh(x);
}
HWY_INLINE V inverse_sinh(V x) {
  return hn::Asinh(D(), x);
}
HWY_INLINE double exponential(double x) {
  return std::exp(x);
}
HWY_INLINE V exponential(V x) {
  return hn::Exp(D(), x);
}
HWY_INLINE double logarithm(double x) {
  return std::log(x);
}
HWY_INLINE V logarithm(V x) {
  return hn::Log(D(), x);
}
/// a b + c
HWY_INLINE double mul_add(double a, double b, double c) {
  return a * b + c;
}
HWY_INLINE V mul_add(V a, V b, V c) {
  return hn::MulAdd(a, b, c);
}
/// Both sides are evaluated.
HWY_INLINE double choose(bool which, double yes, double no) {
  return which ? yes : no;
}
HWY_INLINE V choose(M which, V yes, V no) {
  return hn::IfThenElse(which, yes, no);
}

/// A joint as a term sees it. The third axis of its frame is the stem's; terms bend, they do not
/// twist.
template <class T>
struct BentJoint {
  T k1, k2;      ///< N m/rad, of the two bending axes, now
  T softer;      ///< N m/rad, the smaller of the two
  T elastic;     ///< 1, the share of the stiffness that is elastic
  T phi1, phi2;  ///< rad, its bend from the unloaded shape
};

/// What terms add to a joint beyond its linear spring: moment conjugate to phi and energy are the
/// formula's; `secant` is the stiffness that bounds it from above, and `tangent` what the second
/// derivative of the energy has beyond that. Newton takes the tangent where the whole is positive
/// definite, else the secant.
template <class T>
struct BendTerms {
  T moment1, moment2;                 ///< N m
  T energy;                           ///< J
  T secant1, secant2;                 ///< N m/rad
  T tangent11, tangent22, tangent12;  ///< N m/rad
};

/// A bending spring with moment g(u) K y and u = y.K y / softer, y its bend: `slope` is 2 g', and
/// 2 energy' = g.
template <class T>
struct Radial {
  T g, slope, energy;
};

/// The measure u of a bend y.
template <class T>
HWY_INLINE T bend_measure(const BentJoint<T>& joint, T y1, T y2) {
  const T moment1 = joint.k1 * y1, moment2 = joint.k2 * y2;
  return mul_add(moment1, y1, moment2 * y2) / joint.softer;
}

/// Adds `share` of a radial spring that is bent by y.
template <class T>
HWY_INLINE void add_radial(const BentJoint<T>& joint, T share, T y1, T y2, const Radial<T>& radial,
                           BendTerms<T>& out) {
  const T elastic1 = joint.k1 * y1, elastic2 = joint.k2 * y2;
  const T scale = share * radial.g;
  out.moment1 = mul_add(scale, elastic1, out.moment1);
  out.moment2 = mul_add(scale, elastic2, out.moment2);
  out.energy = mul_add(share * joint.softer, radial.energy, out.energy);
  const T curve = share * radial.slope / joint.softer;
  out.secant1 = mul_add(scale, joint.k1, out.secant1);
  out.secant2 = mul_add(scale, joint.k2, out.secant2);
  out.tangent11 = out.tangent11 + curve * elastic1 * elastic1;
  out.tangent22 = out.tangent22 + curve * elastic2 * elastic2;
  out.tangent12 = out.tangent12 + curve * elastic1 * elastic2;
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::laws
HWY_AFTER_NAMESPACE();

#endif
