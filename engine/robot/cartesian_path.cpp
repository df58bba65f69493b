#include "engine/robot/cartesian_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/io/csv.h"
#include "engine/robot/joint_range.h"

namespace pedicel::robot {

namespace {

using Eigen::VectorXd;

/// 0 to 1 with velocity and acceleration 0 at both ends.
double minimum_jerk(double s) {
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

std::string name_of(const std::vector<Waypoint>& waypoints, std::size_t i) {
  return "waypoint " + std::to_string(i + 1) + " (t = " + io::format_number(waypoints[i].time, 4) +
         " s): ";
}

/// A path that could not be followed: how far it came, and why.
struct Failure {
  std::size_t waypoint = 0;
  double time = 0.0;
  std::string what;
};

struct Path {
  std::vector<double> times;
  std::vector<VectorXd> positions;
  std::optional<Failure> failure;
};

/// Follows the waypoints from one posture at the first of them.
class Follower {
 public:
  Follower(const KinematicModel& model, const std::vector<Waypoint>& waypoints,
           const PathSettings& settings)
      : model_(model), waypoints_(waypoints), settings_(settings) {}

  Path follow(const VectorXd& q_start, const VectorXd& q_first) {
    path_ = {};
    if (waypoints_[0].time > 0.0) {
      add(0.0, q_start);
      joint_move(q_start, q_first);
    } else {
      add(0.0, q_first);
    }
    for (std::size_t i = 1; i < waypoints_.size() && !path_.failure; ++i) straight_move(i);
    return std::move(path_);
  }

 private:
  void add(double time, const VectorXd& q) {
    path_.times.push_back(time);
    path_.positions.push_back(q);
  }

  void fail(std::size_t waypoint, double time, std::string what) {
    path_.failure = Failure{waypoint, time, std::move(what)};
  }

  /// Adds a row where no joint exceeds its speed limit.
  void advance(std::size_t waypoint, double time, const VectorXd& q) {
    const double h = time - path_.times.back();
    for (int i = 0; i < model_.dofs(); ++i) {
      const double speed = std::abs(q[i] - path_.positions.back()[i]) / h;
      if (speed > model_.velocity_limits()[i] * (1.0 + 1e-9))
        return fail(waypoint, time,
                    "too fast: at t = " + io::format_number(time, 4) + " s '" +
                        model_.joint_names()[i] + "' would move at " + io::format_number(speed, 3) +
                        " per second, its limit is " +
                        io::format_number(model_.velocity_limits()[i], 3) +
                        "; give it more time, or lead it further from a singular posture");
    }
    add(time, q);
  }

  int steps(double duration) const {
    return std::max(1, static_cast<int>(std::ceil(duration / settings_.step - 1e-9)));
  }

  void joint_move(const VectorXd& q_start, const VectorXd& q_first) {
    const double duration = waypoints_[0].time;
    const int count = steps(duration);
    for (int k = 1; k <= count && !path_.failure; ++k) {
      const double s = static_cast<double>(k) / count;
      advance(0, s * duration, q_start + minimum_jerk(s) * (q_first - q_start));
    }
  }

  void straight_move(std::size_t i) {
    const Waypoint& to = waypoints_[i];
    const int link = model_.link_index(to.tool);
    const VectorXd q_from = path_.positions.back();
    const Pose from = model_.link_pose(q_from, link);
    const double begin = path_.times.back(), duration = to.time - begin;
    const int count = steps(duration);
    VectorXd q = q_from;
    for (int k = 1; k <= count && !path_.failure; ++k) {
      const double s = minimum_jerk(static_cast<double>(k) / count);
      for (const auto& [name, value] : to.joints) {
        const int joint = model_.joint_index(name);
        q[joint] = q_from[joint] + s * (value - q_from[joint]);
      }
      const double time = begin + duration * k / count;
      const IkResult result = descend(model_, target_between(from, to, link, s), q, settings_.ik);
      if (!result.reached)
        return fail(i, time,
                    "the straight way to it leaves the reach at t = " + io::format_number(time, 4) +
                        " s: nearest reachable pose is " +
                        io::format_number(result.position_error * 1e3, 2) + " mm and " +
                        io::format_number(result.rotation_error * 180.0 / std::numbers::pi, 2) +
                        " degrees away");
      q = result.q;
      advance(i, time, q);
    }
  }

  static IkTarget target_between(const Pose& from, const Waypoint& to, int link, double s) {
    IkTarget target;
    target.link = link;
    target.position_W = from.position + s * (to.position_W - from.position);
    if (to.orientation_W) {
      target.orientation_W = from.rotation.slerp(s, *to.orientation_W);
    } else if (to.approach_W) {
      const Vec3 z = from.rotation * Vec3::UnitZ();
      const Eigen::AngleAxisd whole(Quat::FromTwoVectors(z, *to.approach_W));
      target.approach_W = Eigen::AngleAxisd(s * whole.angle(), whole.axis()) * z;
    }
    return target;
  }

  const KinematicModel& model_;
  const std::vector<Waypoint>& waypoints_;
  const PathSettings& settings_;
  Path path_;
};

IkTarget target_of(const Waypoint& waypoint, const KinematicModel& model) {
  return {model.link_index(waypoint.tool), waypoint.position_W, waypoint.orientation_W,
          waypoint.approach_W};
}

void check_names(const KinematicModel& model, const std::vector<Waypoint>& waypoints,
                 Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& waypoint = waypoints[i];
    const std::string what = name_of(waypoints, i);
    if (model.link_index(waypoint.tool) < 0)
      diagnostics.error(waypoint.where,
                        what + "no link '" + waypoint.tool + "', expected a link of the robot");
    if (i > 0 && !(waypoint.time > waypoints[i - 1].time))
      diagnostics.error(waypoint.where, what + "time does not increase, expected more than " +
                                            io::format_number(waypoints[i - 1].time));
    for (const auto& [name, value] : waypoint.joints) {
      const int joint = model.joint_index(name);
      if (joint < 0)
        diagnostics.error(waypoint.where, what + "unknown joint '" + name +
                                              "', expected a joint that moves by itself");
      else if (const auto fault = outside_range(model, joint, value))
        diagnostics.error(waypoint.where, what + *fault);
    }
  }
}

/// `q` with the joints that a waypoint sets by hand.
VectorXd with_joints(VectorXd q, const Waypoint& waypoint, const KinematicModel& model) {
  for (const auto& [name, value] : waypoint.joints) q[model.joint_index(name)] = value;
  return q;
}

void check_reach(const KinematicModel& model, const std::vector<Waypoint>& waypoints,
                 const VectorXd& q_start, const IkSettings& ik, Diagnostics& diagnostics) {
  VectorXd q = q_start;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    q = with_joints(q, waypoints[i], model);
    const IkResult result = inverse_kinematics(model, target_of(waypoints[i], model), q, ik);
    if (!result.reached)
      diagnostics.error(waypoints[i].where, name_of(waypoints, i) + result.sentence);
    q = result.q;
  }
}

/// Joints that any waypoint sets by hand are not used to reach.
std::vector<int> held_joints(const KinematicModel& model, const std::vector<Waypoint>& waypoints) {
  std::set<int> held;
  for (const Waypoint& waypoint : waypoints)
    for (const auto& item : waypoint.joints) held.insert(model.joint_index(item.first));
  return {held.begin(), held.end()};
}

}  // namespace

Trajectory plan_cartesian(const KinematicModel& model, const std::vector<Waypoint>& waypoints,
                          const VectorXd& q_start, const PathSettings& settings,
                          Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  if (waypoints.empty()) {
    diagnostics.error({}, "no waypoints, expected at least one");
    return {};
  }
  check_names(model, waypoints, diagnostics);
  if (diagnostics.error_count() > before) return {};
  PathSettings path_settings = settings;
  path_settings.ik.held = held_joints(model, waypoints);
  check_reach(model, waypoints, q_start, path_settings.ik, diagnostics);
  if (diagnostics.error_count() > before) return {};

  Follower follower(model, waypoints, path_settings);
  const VectorXd start = with_joints(q_start, waypoints[0], model);
  std::optional<Failure> furthest;
  for (const VectorXd& posture :
       ik_solutions(model, target_of(waypoints[0], model), start, path_settings.ik)) {
    Path path = follower.follow(q_start, posture);
    if (!path.failure) return Trajectory(std::move(path.times), std::move(path.positions));
    if (!furthest || path.failure->time > furthest->time) furthest = path.failure;
  }
  diagnostics.error(waypoints[furthest->waypoint].where,
                    name_of(waypoints, furthest->waypoint) + furthest->what);
  return {};
}

}  // namespace pedicel::robot
