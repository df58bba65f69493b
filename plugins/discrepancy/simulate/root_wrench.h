#pragma once

#include <vector>

#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::discrepancy {

/// How the root moves: m/s and rad/s, W.
struct RootMotion {
  Vec3 velocity = Vec3::Zero(), turning = Vec3::Zero();
};

/// Force (N) and moment (N m) of what carries a plant on it, W, at the root: through the joints
/// there, their damping included. Strain rates are those of the solver's own steps: of a velocity
/// that is a little off, damping would make a large force of a rod that hardly stretches.
class RootWrench {
 public:
  using Wrench = Eigen::Matrix<double, 6, 1>;

  /// Where it begins at `t` (s), moving as the state says, or at rest where `root` is null.
  Wrench begin(const cosserat::RodModel& model, const cosserat::RodState& state, double t,
               const RootMotion* root);
  /// After a step to `t`, of first order where `restarted`; at the time of the last one again where
  /// something jumps there.
  Wrench after(const cosserat::RodModel& model, const cosserat::RodState& state, double t,
               bool restarted);

 private:
  using Strains = std::vector<Eigen::Matrix<double, 6, 1>>;  // 1 and rad, or their rates
  Strains strains(const cosserat::RodModel& model, const cosserat::RodState& state) const;
  Wrench sum(const cosserat::RodModel& model, const cosserat::RodState& state) const;

  std::vector<int> elements_;  // at the root
  Strains last_, before_, rate_;
  double time_ = 0.0, step_ = 0.0;  // s, of the last one; step_ 0: there was none
};

}  // namespace pedicel::discrepancy
