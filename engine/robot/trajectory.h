#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/robot/kinematics.h"

namespace pedicel::robot {

/// Joint positions over time: continuous positions and velocities through given rows (monotone
/// cubic: Fritsch, Carlson 1980), so that nothing overshoots and a value that is held stays held.
/// At rest before the first row and after the last.
class Trajectory {
 public:
  Trajectory() = default;
  /// `times` (s) increase strictly, one row of positions (rad or m) for each. Throws UsageError.
  Trajectory(std::vector<double> times, std::vector<Eigen::VectorXd> positions);

  bool empty() const { return times_.empty(); }
  /// Time of the last row, s.
  double duration() const { return times_.empty() ? 0.0 : times_.back(); }
  const std::vector<double>& times() const { return times_; }                   ///< s
  const std::vector<Eigen::VectorXd>& positions() const { return positions_; }  ///< rad or m
  /// Does not allocate where q and qd have their size.
  void sample(double time, Eigen::VectorXd& q, Eigen::VectorXd& qd) const;

 private:
  std::vector<double> times_;
  std::vector<Eigen::VectorXd> positions_, slopes_;
};

/// Reads `time_s,joint1,joint2,...`: joints by their URDF names, rad or m; joints that the file
/// does not name stay at `q_start`. A column that is no joint, a joint that follows another, and a
/// value outside the limits are errors; then the trajectory comes back empty.
Trajectory read_trajectory_csv(const std::filesystem::path& path, const RobotDescription& robot,
                               const KinematicModel& model, const Eigen::VectorXd& q_start,
                               Diagnostics& diagnostics);

/// The text of such a file, with every degree of freedom and every digit: read again it is the same
/// trajectory.
std::string trajectory_csv(const Trajectory& trajectory, const KinematicModel& model);

}  // namespace pedicel::robot
