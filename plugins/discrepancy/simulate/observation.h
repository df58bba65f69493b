#pragma once

#include <span>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// What the plant really did, step by step, close enough to interpolate: markers by cubic Hermite
/// polynomials, the force linearly.
struct Motion {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::vector<double> time;  ///< s, of each step, 0 first
  Rows position;             ///< steps x 3 markers, m, W
  Rows velocity;             ///< steps x 3 markers, m/s, W
  /// steps x 4 markers, x y z w: how far the element that a marker sits on has turned since it was
  /// drawn, W.
  Rows turn;
  /// s, of each row of `force`. A time stands twice where the force jumps; the second row holds
  /// from then on.
  std::vector<double> force_time;
  Rows force;   ///< rows x 3, N, W: the first hold's pull on the plant
  Rows wrench;  ///< likewise x 6, N and N m, W, at the root; empty where nobody wants it
  std::vector<MeasuredEvent> events;  ///< fruits that came off
  bool began_moving = false;          ///< before time 0, too
  bool healthy = true;                ///< false: the simulation failed where the rows end
};

/// What the instruments report of it.
struct Observed {
  Eigen::MatrixXd markers;          ///< samples x 3 markers, m, W
  Eigen::MatrixXd marker_velocity;  ///< samples x 3 markers, m/s, W: of the plant itself
  Eigen::MatrixXd force;            ///< samples x 3, N, W
  Eigen::MatrixXd wrench;           ///< samples x 6, N and N m, W
};

/// Motion to what the instruments report at `marker_time` (s): marker offset (turning with its
/// element, in the frame the plant was drawn in), latency, frame rotation and scale about the
/// world's origin; the force through gain and offset at `force_time`. An instrument that lags is in
/// its steady state at time 0, and follows exactly what lies between steps (a marker's offset that
/// turns: as a straight line). What began in motion went on before time 0 as it begins, with its
/// acceleration. The wrench at the root at `wrench_time` is as it is. Several effects of a kind add
/// up in their order. Noise and outliers are not part of it. NaN beyond the end of the motion.
Observed observe(const Motion& motion, std::span<const Marker> markers,
                 std::span<const plant::Effect> effects, std::span<const double> marker_time,
                 std::span<const double> force_time, std::span<const double> wrench_time = {});

/// Where a time lies between rows of a motion; of two rows of one time the second counts.
struct Interval {
  int row = -1;         ///< the one before; -1: beyond the end
  double share = 0.0;   ///< of the way to the next
  double length = 0.0;  ///< s, of that way; 0 at an end
};
Interval find_interval(const std::vector<double>& time, double t);

/// s, by how much the markers lag behind the drive.
double latency_of(std::span<const plant::Effect> effects);

}  // namespace pedicel::discrepancy
