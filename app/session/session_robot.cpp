#include "app/session/session_robot.h"

#include <algorithm>
#include <cmath>

#include "app/session/document/file_texts.h"
#include "app/session/live/pick_program.h"
#include "app/session/live/robot_goal.h"
#include "app/session/robot_placing.h"
#include "app/session/session_core.h"
#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/csv.h"
#include "engine/robot/joint_range.h"
#include "plugins/simulation/plants/plant_step.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::app {

namespace {

int joint_of(const robot::KinematicModel& model, const std::string& name) {
  const int joint = model.joint_index(name);
  if (joint >= 0) return joint;
  throw UsageError("no joint \"" + name + "\", expected one of: " + joined(model.joint_names()));
}

void check_limits(const robot::KinematicModel& model, const Eigen::VectorXd& q) {
  constexpr double slack = 1e-6;  // rad or m, of numbers that were rounded to be shown
  for (int i = 0; i < model.dofs(); ++i) {
    if (const auto fault = robot::outside_range(model, i, q[i], slack))
      throw UsageError("joint " + *fault);
  }
}

/// From where the tool is to the target in small steps, each from the last one's joints, as a hand
/// leads it: one descent over a wide turn ends in another branch, and the arm flips over.
robot::IkResult descend_in_steps(const robot::KinematicModel& model, robot::IkTarget target,
                                 const Pose& tool_W, const Vec3& offset, Eigen::VectorXd q,
                                 const robot::IkSettings& settings) {
  constexpr double turn = 0.2, way = 0.05;  // rad, m, of a step
  const Vec3 from = tool_W.position - tool_W.rotation * offset, to = target.position_W;
  const Quat end = target.orientation_W.value_or(tool_W.rotation);
  const double angle = target.orientation_W ? tool_W.rotation.angularDistance(end) : 0.0;
  const double asked = std::max(angle / turn, (to - from).norm() / way);
  const int steps = std::clamp(static_cast<int>(std::ceil(asked)), 1, 60);
  robot::IkResult result;
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    target.position_W = from + share * (to - from);
    if (target.orientation_W) target.orientation_W = tool_W.rotation.slerp(share, end);
    if (i == steps && target.orientation_W) target.orientation_W = end;
    result = robot::descend(model, target, q, settings);
    if (!result.reached) break;
    q = result.q;
  }
  return result;
}

/// s, that the joints need from one place to another by hand; the path between rests at both ends,
/// so that it is one and a half times as fast in its middle.
double travel_time(const Snapshot& now, const robot::KinematicModel& model,
                   const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  if (model.dofs() == 0) return 0.0;
  const Eigen::VectorXd speed = simulation::manual_speed(model, *now.assets->robot);
  return 1.5 * (to - from).cwiseAbs().cwiseQuotient(speed).maxCoeff();
}

/// The rows from 0 s on, and back to the first.
robot::Trajectory lap_of(const Snapshot& now, const robot::KinematicModel& model,
                         const robot::Trajectory& program) {
  std::vector<double> times;
  for (const double time : program.times()) times.push_back(time - program.times().front());
  std::vector<Eigen::VectorXd> positions = program.positions();
  const double back = travel_time(now, model, positions.back(), positions.front());
  if (back > 0.0) {
    times.push_back(times.back() + back);
    positions.push_back(Eigen::VectorXd(positions.front()));
  }
  return {std::move(times), std::move(positions)};
}

}  // namespace

std::shared_ptr<const Snapshot> SessionRobot::snapshot() const {
  return core_.control.snapshot();
}

Command SessionRobot::complete(const Command& add_robot) const {
  return placed_robot(core_.editor.document(), core_.options.packages, add_robot);
}

robot::IkResult SessionRobot::reach(const Pose& tool_W, bool turned) const {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  const world::SceneRobot& scene = *now->assets->scene.robot;
  robot::IkTarget target;
  target.link = now->robot.tool_link;
  target.position_W = tool_W.position - tool_W.rotation * scene.tool_offset;
  if (turned) target.orientation_W = tool_W.rotation;
  robot::IkSettings settings;
  settings.restarts = 6;
  settings.start_preference = 0.1;
  if (!scene.gripper.empty()) settings.held = {joint_of(model, scene.gripper)};
  const Eigen::VectorXd start = start_of(now->robot);
  const robot::IkResult led = descend_in_steps(model, target, tool_at(*now, model, start),
                                               scene.tool_offset, start, settings);
  if (led.reached) return led;
  // Another branch of the arm: the one that turns the joints least.
  const std::vector<Eigen::VectorXd> others = robot::ik_solutions(model, target, start, settings);
  if (others.empty()) return robot::inverse_kinematics(model, target, start, settings);
  return robot::descend(model, target, others.front(), settings);
}

Result SessionRobot::move_joints(const Eigen::VectorXd& q) {
  const robot::KinematicModel model = kinematics_of(*snapshot());
  if (q.size() != model.dofs())
    throw UsageError(std::to_string(q.size()) + " values, expected " +
                     std::to_string(model.dofs()) + ", one a joint");
  check_limits(model, q);
  core_.control.move_robot(q);
  return {};
}

Result SessionRobot::move_joint(const std::string& name, double value) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Eigen::VectorXd q = start_of(now->robot);
  q[joint_of(model, name)] = value;
  return move_joints(q);
}

Result SessionRobot::move_gripper(double value) {
  const auto now = snapshot();
  kinematics_of(*now);  // says where there is no robot
  return move_joint(now->assets->scene.robot->gripper, value);
}

// The pose that was asked for is known as long as the robot goes where that has sent it, or is yet
// to hear of it.
std::optional<ToolGoal> SessionRobot::tool_goal() const {
  const auto now = snapshot();
  if (!now->robot.present || !now->assets || !now->assets->robot) return {};
  if (aim_ && aim_->stage == now->stage && now->step >= aim_->step &&
      (now->robot.goal == aim_->to || now->number <= aim_->number))
    return aim_->goal;
  const robot::KinematicModel model = kinematics_of(*now);
  const Pose tool = tool_at(*now, model, start_of(now->robot));
  return ToolGoal{tool, tool, true, {}};
}

Result SessionRobot::aim_tool(const Pose& tool_W, bool turned, bool as_near_as_can_be) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  // With fewer than six joints a place alone can be asked for.
  const bool holds_turn = turned || tool_freedom(*now, model) >= 6;
  const robot::IkResult found = reach(tool_W, holds_turn);
  if (!found.reached && !as_near_as_can_be) return {false, found.sentence};
  Aim aim;
  aim.to = model.clamped(found.q);
  aim.goal = {tool_W, tool_at(*now, model, aim.to), found.reached, found.sentence};
  if (!holds_turn) aim.goal.asked_W.rotation = aim.goal.nearest_W.rotation;
  if (found.reached) aim.goal.nearest_W = aim.goal.asked_W;
  aim.stage = now->stage, aim.step = now->step, aim.number = now->number;
  const Result moved = move_joints(found.q);
  aim_ = std::move(aim);
  return moved.ok ? Result{true, found.sentence} : moved;
}

Result SessionRobot::jog(const Vec3& shift_W, const Vec3& turn_W) {
  const std::optional<ToolGoal> goal = tool_goal();
  if (!goal) throw UsageError("the scene has no robot");
  Pose tool = goal->nearest_W;
  tool.position += shift_W;
  const double angle = turn_W.norm();
  if (angle > 0.0)
    tool.rotation = (Eigen::AngleAxisd(angle, turn_W / angle) * tool.rotation).normalized();
  return aim_tool(tool, angle > 0.0, false);
}

// Where the robot stands at time 0.
Result SessionRobot::home() {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Eigen::VectorXd q = model.clamped(Eigen::VectorXd::Zero(model.dofs()));
  for (const auto& [name, value] : now->assets->scene.robot->joints)
    if (const int joint = model.joint_index(name); joint >= 0) q[joint] = value;
  return move_joints(q);
}

bool SessionRobot::is_led() const {
  const std::vector<std::string>& log = core_.editor.log().lines();
  for (auto line = log.rbegin(); line != log.rend(); ++line) {
    const std::string verb = line->substr(0, line->find(' '));
    if (*line == "reset" || verb == "play") return false;
    if (*line == "stop robot" || *line == "home robot") return true;
    for (const char* one : {"joint", "joints", "jog", "tool", "gripper"})
      if (verb == one) return true;
  }
  return false;
}

Result SessionRobot::pick(const std::string& organ, const std::optional<Vec3>& pull_W) {
  const auto now = snapshot();
  kinematics_of(*now);  // says where there is no robot
  const FruitPlace fruit = find_fruit(*now, organ);
  const robot::Trajectory program =
      pull_W ? pick_program(*now, fruit, *pull_W) : usual_pick(*now, fruit);
  core_.run_edits.add("pull", *snapshot(), core_.editor.history().size(),
                      true);  // undo takes it back
  const Result result = play(program, false);
  picked_ = Picked{organ, now->stage, now->step, now->time + program.times().back()};
  return result;
}

// A plant that gives way to the end of the pull keeps its fruit: that is said.
void SessionRobot::update() {
  constexpr double later = 0.3;  // s, after the pull
  if (!picked_) return;
  const auto now = snapshot();
  if (now->stage != picked_->stage || now->step < picked_->step) return picked_.reset();
  if (now->time < picked_->end + later) return;
  const Picked picked = *std::exchange(picked_, std::nullopt);
  for (const PlantSnapshot& plant : now->plants)
    for (int f = 0; f < static_cast<int>(plant.model->fruits.size()); ++f) {
      const auto index = static_cast<std::size_t>(f);
      const auto element = static_cast<std::size_t>(plant.model->fruits[index].element);
      if (simulation::fruit_name(*plant.model, f) != picked.organ || !plant.state.alive[element])
        continue;
      const long used = std::lround(100.0 * plant.margin_used[index]);
      core_.messages.say(Severity::warning,
                         "warning: " + picked.organ +
                             " was not taken off: at the end its stalk bears " +
                             std::to_string(used) +
                             " % of what breaks it (a stiffer plant, a weaker stalk or "
                             "\"pick ... pull=X,Y,Z\" another way helps)");
    }
}

robot::Trajectory SessionRobot::waypoint_trajectory(const robot::KinematicModel& model) const {
  if (core_.editor.document().waypoints.empty())
    throw UsageError("no waypoints, expected some to be recorded");
  std::vector<double> times;
  std::vector<Eigen::VectorXd> positions;
  for (const RobotWaypoint& one : core_.editor.document().waypoints) {
    if (static_cast<int>(one.joints.size()) != model.dofs())
      throw UsageError("the waypoint at " + io::format_number(one.time) + " s has " +
                       std::to_string(one.joints.size()) + " joints, expected " +
                       std::to_string(model.dofs()));
    // A place that the robot was in may lie a little outside of the limits.
    for (int i = 0; i < model.dofs(); ++i)
      if (const auto fault =
              robot::outside_range(model, i, one.joints[static_cast<std::size_t>(i)], 0.01))
        throw UsageError("the waypoint at " + io::format_number(one.time) + " s: " + *fault);
    times.push_back(one.time);
    positions.push_back(model.clamped(Eigen::Map<const Eigen::VectorXd>(
        one.joints.data(), static_cast<Eigen::Index>(one.joints.size()))));
  }
  return {std::move(times), std::move(positions)};
}

// A program that begins later than now begins with the way there.
Result SessionRobot::play(robot::Trajectory program, bool loops) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  std::vector<double> times = program.times();
  std::vector<Eigen::VectorXd> positions = program.positions();
  if (!loops) {
    if (times.front() > 0.0) {
      times.insert(times.begin(), 0.0);
      positions.insert(positions.begin(), now->robot.q);
    }
    core_.control.play_trajectory({std::move(times), std::move(positions)});
    return {};
  }
  if (times.size() < 2) throw UsageError("one place is no loop, expected two or more");
  const double lead = std::max(times.front(), travel_time(*now, model, now->robot.q, positions[0]));
  robot::Trajectory way = lead > 0.0 ? robot::Trajectory({0.0, lead}, {now->robot.q, positions[0]})
                                     : robot::Trajectory({0.0}, {positions[0]});
  core_.control.play_loop(std::move(way), lap_of(*now, model, program));
  return {};
}

Result SessionRobot::play_waypoints(bool loops) {
  return play(waypoint_trajectory(kinematics_of(*snapshot())), loops);
}

Result SessionRobot::play_trajectory(const std::filesystem::path& file, bool loops) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Diagnostics diagnostics;
  robot::Trajectory trajectory =
      robot::read_trajectory_csv(file, *now->assets->robot, model, now->robot.q, diagnostics);
  if (diagnostics.has_errors()) return {false, sentences(diagnostics.all()), true};
  return play(std::move(trajectory), loops);
}

Result SessionRobot::save_waypoints(const std::filesystem::path& file) const {
  const robot::KinematicModel model = kinematics_of(*snapshot());
  write_with_backup(file, robot::trajectory_csv(waypoint_trajectory(model), model));
  return {};
}

Result SessionRobot::load_waypoints(const std::filesystem::path& file) {
  const auto now = snapshot();
  const robot::KinematicModel model = kinematics_of(*now);
  Diagnostics diagnostics;
  const robot::Trajectory read =
      robot::read_trajectory_csv(file, *now->assets->robot, model, now->robot.q, diagnostics);
  if (diagnostics.has_errors()) return {false, sentences(diagnostics.all()), true};
  std::vector<double> joints;
  for (const Eigen::VectorXd& row : read.positions())
    joints.insert(joints.end(), row.begin(), row.end());
  return core_.editor.change(
      Command("set waypoints", {{"times", read.times()}, {"joints", std::move(joints)}}));
}

Result SessionRobot::stop() {
  kinematics_of(*snapshot());  // says where there is no robot
  core_.control.stop_robot();
  return {};
}

}  // namespace pedicel::app
