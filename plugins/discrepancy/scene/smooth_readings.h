#pragma once

#include <Eigen/Dense>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Positions of joints over time with their first two derivatives: a spline of fifth degree, still
/// before its first and after its last row.
class JointPath {
 public:
  struct Point {
    Eigen::VectorXd q, qd, qdd;  ///< rad, rad/s, rad/s2 (or m)
  };
  int dofs() const { return static_cast<int>(q_.cols()); }
  double end() const { return time_.empty() ? 0.0 : time_.back(); }  ///< s
  Point at(double t) const;
  void sample(double t, Eigen::VectorXd& q) const;  ///< positions alone
  /// The same of a robot whose other joints stand at `start`: column i is joint `columns[i]` of it.
  JointPath spread(const std::vector<int>& columns, const Eigen::VectorXd& start) const;
  /// Through rows as they are; accelerations are differences of their velocities.
  static JointPath through(std::vector<double> time, const std::vector<Eigen::VectorXd>& positions,
                           const std::vector<Eigen::VectorXd>& velocities);
  /// rad, RMS of readings less spline, by column.
  const Eigen::VectorXd& scatter() const { return scatter_; }

  friend JointPath smooth_readings(const Samples& readings, double deviation);

 private:
  struct Local {
    int row = 0;
    double u = 0.0, h = 0.0;  // 1, s
    bool rests = false;
  };
  Local find(double t) const;

  std::vector<double> time_;      // s
  Eigen::MatrixXd q_, qd_, qdd_;  // rows x dofs
  Eigen::VectorXd scatter_;
};

/// The smoothing spline of readings whose noise has that deviation (rad; 0: it is estimated): the
/// mean of a process whose jerk is white noise, given the readings (Wahba 1978), by a Kalman filter
/// and a smoother (Rauch, Tung, Striebel 1965). How strong the jerk is, is chosen by the
/// likelihood of the readings around: an arm rests and moves in turn.
/// Gaps (NaN) are bridged.
JointPath smooth_readings(const Samples& readings, double deviation);

}  // namespace pedicel::discrepancy
