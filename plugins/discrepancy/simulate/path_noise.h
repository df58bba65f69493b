#pragma once

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// What the noise of a trial's own paths adds to its channels: markers' columns first, then the
/// force's and the wrench's.
struct PathNoise {
  Eigen::VectorXd variance;  ///< m2, N2, (N m)2; empty: nothing is added
  double until = 0.0;        ///< s: nothing is led any more
};

/// One a trial, with StatedNoise::path_std. It counts as white and as it answers at time 0: each
/// path of the nominal plant is moved aside by the deviation, axis by axis, and what that changes
/// at rest is a deviation of the channel while something is led.
std::vector<PathNoise> path_noise(const Experiment& experiment);

}  // namespace pedicel::discrepancy
