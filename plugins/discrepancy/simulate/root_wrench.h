#pragma once

#include "pedicel/cosserat/model/rod_state.h"

namespace pedicel::discrepancy {

/// How the root moves: m/s and rad/s, W.
struct RootMotion {
  Vec3 velocity = Vec3::Zero(), turning = Vec3::Zero();
};

/// Force (N) and moment (N m) of what carries the plant on it, W, at the root: through the joints
/// there, their damping included.
Eigen::Matrix<double, 6, 1> root_wrench(const cosserat::RodModel& model,
                                        const cosserat::RodState& state, const RootMotion& root);

}  // namespace pedicel::discrepancy
