#pragma once

#include <Eigen/Dense>

namespace pedicel::simulation {

/// rad or m, and rad/s or m/s, of all joints.
struct JointTargets {
  Eigen::VectorXd q, qd;
};

/// How a robot's drives differ from ideal ones: they follow their targets with a lag of first
/// order, and its links stand beyond what its encoders read. Without either it changes nothing.
class DriveError {
 public:
  /// s; 0: at once.
  void set_lag(double time) { lag_ = time; }
  /// How far links are beyond what their encoders read, rad or m.
  void set_deflection(const Eigen::VectorXd& deflection) { deflection_ = deflection; }

  /// What the motors get for the end of a step of `dt` s where they are told `q` and `qd`; null:
  /// just that. The lag begins at `positions`.
  const JointTargets* follow(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                             const Eigen::VectorXd& positions, double dt);
  /// What a joint's encoder reads where its link stands at `position`, rad or m.
  double reading(int joint, double position) const {
    return position - (deflection_.size() > 0 ? deflection_[joint] : 0.0);
  }

 private:
  double lag_ = 0.0;            // s
  JointTargets lagged_;         // empty: not begun
  Eigen::VectorXd deflection_;  // empty: nothing gives way
};

}  // namespace pedicel::simulation
