// The formula of clamp_play. Included once an instruction set.
#if defined(PEDICEL_LAWS_CLAMP_PLAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_LAWS_CLAMP_PLAY_INL_H
#undef PEDICEL_LAWS_CLAMP_PLAY_INL_H
#else
#define PEDICEL_LAWS_CLAMP_PLAY_INL_H
#endif

#include "plugins/cosserat/laws/joint_term-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::laws {
namespace HWY_NAMESPACE {

/// A joint that bends freely up to an angle a and as its spring beyond, in whichever direction:
/// with r = sqrt(u), |phi| where the two bending stiffnesses are equal, the moment is K phi (1 -
/// a/r) where r > a and 0 below. Its energy softer (r - a)^2 / 2 is convex, so that Newton's
/// tangent is never negative.
struct clamp_play {
  static constexpr int numbers = 1;      // rad, a
  static constexpr double least = 0.05;  // 1, of the spring's stiffness

  template <class T>
  static HWY_INLINE void add(const T* numbers, const BentJoint<T>& joint, BendTerms<T>& out) {
    const T play = numbers[0], zero = number(play, 0.0), one = number(play, 1.0);
    const T u = bend_measure(joint, joint.phi1, joint.phi2);
    const T bend = root(u);
    const auto beyond = bend > play;
    const T safe = choose(beyond, bend, one), over = choose(beyond, bend - play, zero);
    const T slope = choose(beyond, play / (safe * safe * safe), zero);
    // Beyond what is linear of it, which is there.
    const T less = over / safe - one;
    add_radial(joint, joint.elastic, joint.phi1, joint.phi2,
               {less, slope, number(play, 0.5) * (over * over - u)}, out);
    // Factors are of single precision: beside the stem's stretch a joint of no stiffness would be
    // lost in them. Newton takes a twentieth for it, which only makes its way longer.
    const T lifted = joint.elastic * larger(zero, number(play, least - 1.0) - less);
    out.secant1 = mul_add(lifted, joint.k1, out.secant1);
    out.secant2 = mul_add(lifted, joint.k2, out.secant2);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::laws
HWY_AFTER_NAMESPACE();

#endif
