#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/robot/kinematics.h"

namespace pedicel::robot {

/// Where a link shall be, in the world. With neither orientation nor approach the link may turn as
/// it likes; with `approach` only its z axis is told where to point.
struct IkTarget {
  int link = 0;
  Vec3 position_W = Vec3::Zero();  ///< m, of the link's origin
  std::optional<Quat> orientation_W;
  std::optional<Vec3> approach_W;  ///< unit; ignored where there is an orientation
};

struct IkSettings {
  double position_tolerance = 1e-5;  ///< m
  double rotation_tolerance = 1e-4;  ///< rad
  int iterations = 200;              ///< of one start
  int restarts = 40;                 ///< from random positions, after the start that was given
  std::uint64_t seed = 1;            ///< of the restarts
  double radian_length = 0.1;        ///< m, what an error of one radian weighs
  std::vector<int> held;             ///< joints that keep their value
  /// 1, >= 0: where nothing reaches, the descent from the given start counts as the nearest unless
  /// a restart is nearer by more than this share. Keeps an arm that is led by hand from jumping.
  double start_preference = 0.0;
};

struct IkResult {
  Eigen::VectorXd q;
  bool reached = false;
  double position_error = 0.0;  ///< m
  double rotation_error = 0.0;  ///< rad; about the approach axis not counted
  std::string sentence;         ///< empty where reached; else "unreachable: ...", for people
};

/// One descent by damped least squares (Levenberg-Marquardt: Nakamura, Hanafusa 1986) that keeps
/// every joint within its limits, from `q_start`. Joints that do not move the link stay as they
/// are. `sentence` stays empty.
IkResult descend(const KinematicModel& model, const IkTarget& target,
                 const Eigen::VectorXd& q_start, const IkSettings& settings = {});

/// Descends from `q_start`, then from seeded random positions until one reaches the target. Where
/// none does, the result is the best one, and its sentence says how near the robot can come.
IkResult inverse_kinematics(const KinematicModel& model, const IkTarget& target,
                            const Eigen::VectorXd& q_start, const IkSettings& settings = {});

/// All different solutions that the restarts find, the nearest to `q_start` first.
std::vector<Eigen::VectorXd> ik_solutions(const KinematicModel& model, const IkTarget& target,
                                          const Eigen::VectorXd& q_start,
                                          const IkSettings& settings = {});

/// How far a link at `pose` is from a target: metres, and radians about the axes that count.
std::pair<double, double> ik_error(const Pose& pose, const IkTarget& target);

}  // namespace pedicel::robot
