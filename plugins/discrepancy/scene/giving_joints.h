#pragma once

#include <Eigen/Dense>
#include <optional>

#include "engine/robot/dynamics.h"
#include "plugins/discrepancy/scene/arm.h"

namespace pedicel::discrepancy {

/// Joints that give way between encoders and links: damped springs that carry the links' own
/// inertia. Weight and inertia of the motion itself are the controller's, so only what plants exert
/// moves them: M d'' + K (T d' + d) = effort. Newmark's method.
class GivingJoints {
 public:
  /// `dt`: s, of a step. Keeps a reference to nothing.
  GivingJoints(const Arm& arm, const SceneState& state, double dt);

  bool give() const { return stiffness_ > 0.0; }
  /// Where the joints would be at the step's end if the effort stayed, links being at `q`.
  void begin_step(const Eigen::VectorXd& q);
  /// The effort of the plants at the step's end, N m.
  void end_step(const Eigen::VectorXd& effort);

  const Eigen::VectorXd& deflection() const { return deflection_; }  ///< rad
  /// rad/(N m): of the deflection by what the effort changes within a step.
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  /// Deflection, its speed and its acceleration one after another.
  Eigen::RowVectorXd row() const;

 private:
  void solve();

  double dt_, stiffness_, damping_ = 0.0;  // s, N m/rad, N m s/rad
  Eigen::VectorXd effort_, deflection_, speed_, acceleration_;
  Eigen::VectorXd free_deflection_, free_speed_;  // without the step's own acceleration
  Eigen::MatrixXd compliance_;
  std::optional<robot::Dynamics> dynamics_;
};

}  // namespace pedicel::discrepancy
