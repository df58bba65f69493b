#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/yaml.h"
#include "engine/robot/inverse_kinematics.h"
#include "engine/robot/trajectory.h"

namespace pedicel::robot {

/// Where a tool link shall be at a time, and where joints that are set by hand (a gripper) shall
/// be.
struct Waypoint {
  double time = 0.0;                     ///< s
  std::string tool;                      ///< a link's name
  Vec3 position_W = Vec3::Zero();        ///< m
  std::optional<Quat> orientation_W;     ///< of the tool; else
  std::optional<Vec3> approach_W;        ///< where the tool's z axis points; else as it likes
  std::map<std::string, double> joints;  ///< rad or m; they keep their value until set again
  SourcePosition where;                  ///< for errors
};

struct PathSettings {
  double step = 0.01;  ///< s between inverse kinematics solutions along the path
  IkSettings ik;
};

/// Plans joint positions through waypoints. From `q_start` at time 0 the robot moves in joint space
/// to the first waypoint (or stands there where its time is 0); from each waypoint to the next the
/// tool runs on a straight line while it turns evenly, at rest at every waypoint, with the minimum
/// jerk profile 10 s^3 - 15 s^4 + 6 s^5 (Flash, Hogan 1985). Every solution starts from the one
/// before, so that the path is continuous; where a path cannot be followed from one arm posture,
/// the others that reach the first waypoint are tried.
///
/// Unknown names, waypoints out of reach, paths that leave the reach and joints that would have to
/// turn faster than their limit are errors that name waypoint and time; then the trajectory comes
/// back empty. Waypoints count from 1.
Trajectory plan_cartesian(const KinematicModel& model, const std::vector<Waypoint>& waypoints,
                          const Eigen::VectorXd& q_start, const PathSettings& settings,
                          Diagnostics& diagnostics);

}  // namespace pedicel::robot
