// All terms of a joint, for the solver's kernels and for the scalar law. Included once an
// instruction set.
#if defined(PEDICEL_LAWS_JOINT_TERMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEDICEL_LAWS_JOINT_TERMS_INL_H
#undef PEDICEL_LAWS_JOINT_TERMS_INL_H
#else
#define PEDICEL_LAWS_JOINT_TERMS_INL_H
#endif

#include "plugins/cosserat/laws/asymmetry-inl.h"
#include "plugins/cosserat/laws/clamp_play-inl.h"
#include "plugins/cosserat/laws/joint_terms.h"
#include "plugins/cosserat/laws/material_nonlinearity-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pedicel::laws {
namespace HWY_NAMESPACE {

/// Adds the term with the formula `Law` and its row of joint_terms, where its bit is set.
template <class Law, class T>
HWY_INLINE void add_joint_term(const JointTerm& term, unsigned which, const T* numbers,
                               const BentJoint<T>& joint, BendTerms<T>& out) {
  if (which & term.bit) Law::add(numbers + term.first, joint, out);
}

/// Adds the terms of a joint whose bits are set in `which`; `numbers` are joint_term_numbers.
template <class T>
HWY_INLINE void add_joint_terms(unsigned which, const T* numbers, const BentJoint<T>& joint,
                                BendTerms<T>& out) {
  static_assert(joint_terms[0].numbers == clamp_play::numbers &&
                joint_terms[1].numbers == material_nonlinearity::numbers &&
                joint_terms[2].numbers == asymmetry::numbers);
  add_joint_term<clamp_play>(joint_terms[0], which, numbers, joint, out);
  add_joint_term<material_nonlinearity>(joint_terms[1], which, numbers, joint, out);
  add_joint_term<asymmetry>(joint_terms[2], which, numbers, joint, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace pedicel::laws
HWY_AFTER_NAMESPACE();

#endif
