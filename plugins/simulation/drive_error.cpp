#include "plugins/simulation/drive_error.h"

#include <cmath>

namespace pedicel::simulation {

// First order, exact for a target that goes evenly within a step.
const JointTargets* DriveError::follow(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                                       const Eigen::VectorXd& positions, double dt) {
  if (!(lag_ > 0.0)) return nullptr;
  if (lagged_.q.size() == 0) lagged_.q = positions;
  const double kept = std::exp(-dt / lag_);
  const Eigen::VectorXd before = lagged_.q;
  lagged_.q = q - lag_ * qd + kept * (before - q + dt * qd + lag_ * qd);
  lagged_.qd = (lagged_.q - before) / dt;
  return &lagged_;
}

}  // namespace pedicel::simulation
