// The spring with a memory of hysteresis. Included once an instruction set.
#if defined(PEDICEL_LAWS_HYSTERESIS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_LAWS_HYSTERESIS_INL_H
#undef PEDICEL_LAWS_HYSTERESIS_INL_H
#else
#define PEDICEL_LAWS_HYSTERESIS_INL_H
#endif

#include "plugins/cosserat/laws/joint_term-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::laws {
namespace HWY_NAMESPACE {

/// Where a spring stands after a step: its bend y, dy by the joint's bend, and the integral of y
/// over the joint's bend.
template <class T>
struct Bent {
  T y, slope, energy;
};

/// y' = h (1 - y/e) from y = 0 on, h > 0: y = e (1 - exp(-h x/e)) at x >= 0. `rate` is h/e, 0 or
/// more.
template <class T>
HWY_INLINE Bent<T> approach(T h, T rate, T x) {
  const T one = number(x, 1.0), w = rate * x;
  // Where w is small the closed forms lose digits.
  // Five terms at w below 0.01 are exact to rounding. The lanes compute both ways, and choose: a
  // branch would split them.
  const auto short_way = w < number(x, 1.0e-2);
  const T far = choose(short_way, one, w);
  const T left = exponential(negative(w));
  const T y_far = (one - left) / far;
  const T energy_far = (one - y_far) / far;
  const auto series = [&](double a, double b, double c, double d, double e) {
    return mul_add(
        w,
        mul_add(w, mul_add(w, mul_add(w, number(x, e), number(x, d)), number(x, c)), number(x, b)),
        number(x, a));
  };
  const T y = choose(short_way, series(1.0, -1.0 / 2, 1.0 / 6, -1.0 / 24, 1.0 / 120), y_far);
  const T energy =
      choose(short_way, series(1.0 / 2, -1.0 / 6, 1.0 / 24, -1.0 / 120, 1.0 / 720), energy_far);
  return {h * x * y, h * left, h * x * x * energy};
}

/// Bouc-Wen's y' = 1 - |y/reach|^exponent sign(dphi y) along one axis, after dphi >= 0 from `y0`
/// within +-reach. Its right side is taken as straight in y: with its own slope at y0 up to where
/// it would leave [0, 1] (loading) or fall below 1 (unloading), and from 0 on when y changes sign.
/// That is exact for the exponent 1, and of second order in dphi for others. y never decreases with
/// dphi, so that there is an energy, and never passes `reach`.
template <class T>
HWY_INLINE Bent<T> bouc_wen(T reach, T exponent, T y0, T dphi) {
  const T zero = number(y0, 0.0), one = number(y0, 1.0);
  const T share = smaller(magnitude(y0) / reach, one);
  // |y/reach|^(exponent - 1), 1 at y = 0 for the exponent 1 and 0 for larger ones.
  const T tiny = number(y0, 1.0e-30);
  const T power = exponential((exponent - one) * logarithm(larger(share, tiny)));
  const T level = share * power, bend = exponent * power / reach;
  // Unloading, while y0 < 0: y rises by at most -y0. First its rate falls from 1 + level to 1.
  // After a turn the spring is stiffer than K: y goes back and its own level helps. That is why
  // loops have corners.
  const T below = larger(negative(y0), zero);
  const T steep = one + level;
  const T first = below / exponent;  // of the way to 0
  const T gone = bend * first / steep;
  // The x at which steep (1 - exp(-bend x)) / bend = first.
  const T until_even =
      choose(gone < number(y0, 1.0e-6), first / steep * (one + number(y0, 0.5) * gone),
             negative(logarithm(one - gone)) / larger(bend, tiny));
  const T until_zero = until_even + (below - first);
  const T x1 = smaller(dphi, until_even);
  const Bent<T> one_way = approach(steep, bend, x1);
  const T x2 = smaller(larger(dphi - until_even, zero), below - first);
  const T x3 = larger(dphi - until_zero, zero);
  // Loading, from max(y0, 0) on: up to `reach` at most.
  const auto unloads = y0 < zero;
  const T from = larger(y0, zero);
  const T rest = one - choose(unloads, zero, level);
  const T loading_bend = choose(unloads, choose(exponent > one, zero, one / reach), bend);
  const T room = larger(reach - from, zero);
  // Where it would pass `reach`: rest (1 - exp(-bend x)) / bend = room.
  const T used = loading_bend * room / larger(rest, tiny);
  const T until_full =
      choose(used < number(y0, 1.0e-6), room / larger(rest, tiny) * (one + number(y0, 0.5) * used),
             negative(logarithm(larger(one - used, tiny))) / larger(loading_bend, tiny));
  const T x4 = smaller(x3, until_full), x5 = x3 - x4;
  const Bent<T> other_way = approach(rest, loading_bend, x4);
  // Put together.
  const T at_even = negative(below) + one_way.y, at_zero = at_even + x2;
  const T y = choose(unloads, at_zero, from) + other_way.y;
  const T unloading_energy = mul_add(negative(below), x1, one_way.energy) +
                             mul_add(at_even, x2, number(y0, 0.5) * x2 * x2);
  const T loading_energy = mul_add(from, x4, other_way.energy) + (from + other_way.y) * x5;
  const T slope = choose(x3 > zero, choose(x5 > zero, zero, other_way.slope),
                         choose(unloads, choose(x2 > zero, one, one_way.slope), other_way.slope));
  return {smaller(y, reach), slope, choose(unloads, unloading_energy, zero) + loading_energy};
}

/// The same for dphi of either sign.
template <class T>
HWY_INLINE Bent<T> bouc_wen_either(T reach, T exponent, T y0, T dphi) {
  const auto back = dphi < number(y0, 0.0);
  const Bent<T> found = bouc_wen(reach, exponent, choose(back, negative(y0), y0), magnitude(dphi));
  return {choose(back, negative(found.y), found.y), found.slope, found.energy};
}

/// A spring of `share` of a joint's stiffness with the memory: it is bent by y at the step's start,
/// phi there is `start`. In two directions: along y Bouc-Wen's equation, across it the same from
/// y = 0 on, as the equation of two directions says for a short way. Bends are measured so that
/// both axes are as stiff as the softer one. Returns y at the end.
template <class T>
struct BentTwice {
  T y1, y2;
};
template <class T>
HWY_INLINE BentTwice<T> add_hysteresis(const BentJoint<T>& joint, T share, T reach, T exponent,
                                       const BentTwice<T>& before, const BentTwice<T>& start,
                                       BendTerms<T>& out) {
  const T zero = number(share, 0.0), one = number(share, 1.0);
  const T s1 = root(joint.k1 / joint.softer), s2 = root(joint.k2 / joint.softer);
  const T y1 = s1 * before.y1, y2 = s2 * before.y2;
  const T size = root(mul_add(y1, y1, y2 * y2));
  const auto bent = size > number(share, 1.0e-15);
  const T safe = choose(bent, size, one);
  const T a1 = choose(bent, y1 / safe, one), a2 = choose(bent, y2 / safe, zero);
  const T d1 = s1 * (joint.phi1 - start.y1), d2 = s2 * (joint.phi2 - start.y2);
  const Bent<T> along =
      bouc_wen_either(reach, exponent, smaller(size, reach), mul_add(a1, d1, a2 * d2));
  const Bent<T> across = bouc_wen_either(reach, exponent, zero, a1 * d2 - a2 * d1);
  const T n1 = mul_add(a1, along.y, negative(a2 * across.y));
  const T n2 = mul_add(a2, along.y, a1 * across.y);
  const T k = share * joint.softer;
  out.moment1 = mul_add(k * s1, n1, out.moment1);
  out.moment2 = mul_add(k * s2, n2, out.moment2);
  out.energy = mul_add(k, along.energy + across.energy, out.energy);
  // dy/dphi is 2 at most.
  const T most1 = number(share, 2.0) * share * joint.k1;
  const T most2 = number(share, 2.0) * share * joint.k2;
  out.secant1 = out.secant1 + most1;
  out.secant2 = out.secant2 + most2;
  out.tangent11 = out.tangent11 - most1 +
                  share * joint.k1 * mul_add(a1 * a1, along.slope, a2 * a2 * across.slope);
  out.tangent22 = out.tangent22 - most2 +
                  share * joint.k2 * mul_add(a2 * a2, along.slope, a1 * a1 * across.slope);
  out.tangent12 = mul_add(k * s1 * s2 * a1 * a2, along.slope - across.slope, out.tangent12);
  // What both ways together pass `reach` by is given way to.
  // Each way by itself keeps within its reach, their sum need not. Only the memory is cut, so that
  // this step's moment stays the slope of its energy.
  const T end = root(mul_add(n1, n1, n2 * n2));
  const T kept = choose(end > reach, reach / choose(end > reach, end, one), one);
  return {kept * n1 / s1, kept * n2 / s2};
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::laws
HWY_AFTER_NAMESPACE();

#endif
