#pragma once

#include <span>

#include "discrepancy/experiment.h"

namespace pedicel::discrepancy {

/// What the plant really did, at times close enough to interpolate (cubic in time between steps).
struct Motion {
  std::vector<double> time;     ///< s, of each step, 0 first
  Eigen::MatrixXd position;     ///< steps x 3 markers, m, W
  Eigen::MatrixXd velocity;     ///< steps x 3 markers, m/s, W
  Eigen::MatrixXd orientation;  ///< steps x 4 markers, x y z w, of the element a marker sits on
  Eigen::MatrixXd force;        ///< steps x 3, N, W: the first hold's pull on the plant
};

/// Motion to what the instruments report at `marker_time` (s): marker offset (turning with its
/// element, in the frame the plant was drawn in), latency, frame rotation and scale about the
/// world's origin; the force through gain and offset at `force_time`. Noise and outliers are not
/// part of it.
struct Observed {
  Eigen::MatrixXd markers;          ///< samples x 3 markers, m, W
  Eigen::MatrixXd marker_velocity;  ///< m/s
  Eigen::MatrixXd force;            ///< samples x 3, N, W
};
Observed observe(const Motion& motion, std::span<const Marker> markers,
                 std::span<const plant::Effect> effects, std::span<const double> marker_time,
                 std::span<const double> force_time);

}  // namespace pedicel::discrepancy
