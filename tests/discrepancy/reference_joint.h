#pragma once

#include "tests/discrepancy/reference_tree.h"

namespace pedicel::reference {

/// What a joint remembers at one instant; `q` holds one vector a memory term.
struct JointPast {
  Vec3 slip = Vec3::Zero();     ///< rad, of the slider
  Vec3 plastic = Vec3::Zero();  ///< rad, permanent
  Vec3 moved = Vec3::Zero();    ///< rad, phi from the settled one, where `wound` is known
  Vec3 wound = Vec3::Zero();    ///< rad, Bouc-Wen's z over K
};

/// One evaluation of a joint within a Runge-Kutta stage.
struct JointInput {
  Quat relative;                ///< child to parent
  Vec3 rate = Vec3::Zero();     ///< rad/s, relative, in the child's frame
  Vec3 settled = Vec3::Zero();  ///< rad, phi at time 0
  Vec3 hung = Vec3::Zero();     ///< rad, phi to which hung terms had relaxed
  JointPast past;               ///< at the step's start: sliding does not depend on the rate
  double stiffening = 1.0;      ///< of E, by drift
  double stage = 0.0;           ///< s, gamma h; 0: time 0, everything unrelaxed
};

struct JointOutput {
  Vec3 phi = Vec3::Zero();     ///< rad, from the rest shape
  Vec3 torque = Vec3::Zero();  ///< N m, on the child, in its frame
  JointPast past;              ///< after sliding
};

/// Evaluates the law. `q_known` and `q` have one entry a memory term: q at the stage is implicit,
/// q = q_known + stage q'.
JointOutput evaluate(const Joint& joint, const JointLaw& law, const JointInput& in,
                     const Vec3* q_known, Vec3* q);

}  // namespace pedicel::reference
