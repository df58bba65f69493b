#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/model/joint_law.h"

namespace pedicel::plain {

/// How one joint answers its rotation vector phi (rad, E) over a step (plugins/cosserat/README.md,
/// "Laws of joints and air").
struct JointStep {
  Vec3 stiffness;                           ///< N m/rad, K with drift
  double stiffening = 1.0;                  ///< 1, 1 + damping time / h~
  Vec3 target;                              ///< rad, of Kelvin-Voigt damping
  const cosserat::JointLaw* law = nullptr;  ///< nullptr: none
  std::span<const Vec3> memory;             ///< rad, z of its branches
  Vec3 bias = Vec3::Zero();                 ///< rad
  Vec3 now = Vec3::Zero();                  ///< rad, phi at the step's start
  double dt = 0.0;                          ///< s
};

struct JointAnswer {
  Vec3 moment = Vec3::Zero();     ///< N m, conjugate to phi
  double energy = 0.0;            ///< J
  Mat3 stiffness = Mat3::Zero();  ///< N m/rad, positive definite: the tangent or the secant
};

JointAnswer answer(const JointStep& joint, const Vec3& phi);

/// The memory at the step's end, where the joint is bent by `phi`.
std::vector<Vec3> memory_after(const JointStep& joint, const Vec3& phi);

}  // namespace pedicel::plain
