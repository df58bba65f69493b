#include "engine/io/csv.h"
#include "engine/robot/cartesian_path.h"
#include "engine/robot/holding_effort.h"
#include "engine/robot/joint_range.h"
#include "engine/robot/read/read_robot.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

namespace {

using FindPlace = std::function<std::optional<Vec3>(const world::Anchor&)>;

/// Turns a scene's waypoints into those of the robot: anchors become places, the tool's offset is
/// taken off, and the gripper's opening becomes its joint.
std::vector<robot::Waypoint> waypoints_of(const world::SceneRobot& scene,
                                          const RobotControl& control, const FindPlace& find,
                                          Diagnostics& diagnostics) {
  std::vector<robot::Waypoint> all;
  // A waypoint without an orientation keeps the one before it, the first the start's.
  Quat orientation = control.tool_pose().rotation;
  for (const world::SceneWaypoint& given : scene.waypoints) {
    robot::Waypoint waypoint;
    waypoint.time = given.time;
    waypoint.tool = control.description().links[control.tool_link()].name;
    waypoint.where = given.where;
    orientation = given.orientation.value_or(orientation);
    waypoint.orientation_W = orientation;
    // Planned for the link; the scene speaks of the point that grasps.
    waypoint.position_W = given.position - orientation * scene.tool_offset;
    if (given.at.kind != world::Anchor::Kind::none) {
      const std::optional<Vec3> place = find(given.at);
      if (!place)
        diagnostics.error(given.where,
                          "at: \"" + given.at.name +
                              "\" is not there, expected a fruit, body or plant of this scene");
      // Planned once, for where it is at the start: a program does not look.
      waypoint.position_W += place.value_or(Vec3::Zero());
    }
    if (given.gripper && !scene.gripper.empty()) waypoint.joints[scene.gripper] = *given.gripper;
    all.push_back(std::move(waypoint));
  }
  return all;
}

/// Start values must lie within the limits: they are where the run begins.
void check_start(const world::SceneRobot& scene, const robot::KinematicModel& model,
                 Diagnostics& diagnostics) {
  constexpr double slack = 1e-6;  // rad or m, of limits that were rounded to be typed
  for (const auto& [joint, value] : scene.joints) {
    const int dof = model.joint_index(joint);
    if (dof < 0) continue;
    const auto place = scene.joints_where.find(joint);
    const SourcePosition& where = place == scene.joints_where.end() ? scene.where : place->second;
    // A start beyond the limits would be moved by Bullet in the first step, with a jerk.
    if (const auto fault = robot::outside_range(model, dof, value, slack))
      diagnostics.error(where, "joints: " + *fault);
    else if (const auto doubt = robot::many_turns(model, dof, value))
      diagnostics.warning(where, "joints: " + *doubt);
  }
}

void check_recorded(const world::SceneRobot& scene, const robot::KinematicModel& model,
                    Diagnostics& diagnostics) {
  for (const world::RecordedPose& pose : scene.recorded) {
    if (static_cast<int>(pose.joints.size()) != model.dofs()) continue;  // said when it is played
    for (int i = 0; i < model.dofs(); ++i)
      if (const auto fault =
              robot::outside_range(model, i, pose.joints[static_cast<std::size_t>(i)], 0.01))
        diagnostics.error(scene.where,
                          "recorded: at " + io::format_number(pose.time) + " s: " + *fault);
  }
}

void check_names(const world::SceneRobot& scene, const robot::RobotDescription& description,
                 Diagnostics& diagnostics) {
  const robot::KinematicModel model(description);
  const auto joint_error = [&](const std::string& what) {
    std::string names;
    for (const std::string& name : model.joint_names()) names += (names.empty() ? "" : ", ") + name;
    diagnostics.error(scene.where, what + ", expected one of: " + names);
  };
  for (const auto& [joint, value] : scene.joints)
    if (model.joint_index(joint) < 0) joint_error("joints: no joint \"" + joint + "\" to set");
  check_start(scene, model, diagnostics);
  check_recorded(scene, model, diagnostics);
  if (!scene.gripper.empty() && model.joint_index(scene.gripper) < 0)
    joint_error("gripper: no joint \"" + scene.gripper + "\"");
  if (!scene.tool.empty() && description.link(scene.tool) < 0)
    diagnostics.error(scene.where, "tool: no link \"" + scene.tool + "\" in " + description.file);
}

void plan(const world::SceneRobot& scene, RobotControl& control, const FindPlace& find,
          const LedRobot& led, Diagnostics& diagnostics) {
  std::optional<robot::KinematicModel> believed;
  if (led.believed) believed.emplace(*led.believed, scene.base);
  const robot::KinematicModel& model = believed ? *believed : control.robot().model();
  const Eigen::VectorXd start = control.robot().positions();
  const int before = diagnostics.error_count();
  if (!scene.trajectory.empty()) {
    control.set_trajectory(robot::read_trajectory_csv(scene.trajectory, control.description(),
                                                      model, start, diagnostics),
                           -led.log_delay);
  } else if (!scene.waypoints.empty()) {
    // Not planned with a place missing: one fault would become several.
    const auto waypoints = waypoints_of(scene, control, find, diagnostics);
    if (diagnostics.error_count() == before)
      control.set_trajectory(robot::plan_cartesian(model, waypoints, start, {}, diagnostics));
  }
}

}  // namespace

std::optional<robot::RobotDescription> read_robot(const world::SceneRobot& scene,
                                                  const std::vector<std::string>& packages,
                                                  Diagnostics& diagnostics) {
  robot::PackagePaths paths = robot::PackagePaths::from_environment();
  for (const auto& [name, path] : scene.packages) paths.add(name + "=" + path.string());
  for (const std::string& package : packages) paths.add(package);
  const int before = diagnostics.error_count();
  auto description = robot::read_robot(scene.file, paths, diagnostics);
  if (description) check_names(scene, *description, diagnostics);
  if (diagnostics.error_count() > before) return std::nullopt;
  return description;
}

std::unique_ptr<RobotControl> make_robot_control(const world::SceneRobot& scene,
                                                 const robot::RobotDescription& description,
                                                 world::SimWorld& world, const FindPlace& find,
                                                 const LedRobot& led, Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  auto control = std::make_unique<RobotControl>(scene, description, world, led.moves);
  if (led.readings) {
    control->lead_by_readings(led.readings);
    return control;
  }
  control->drives().set_lag(led.lag);
  plan(scene, *control, find, led, diagnostics);
  if (diagnostics.error_count() > before) return nullptr;
  // Without motors an arm is meant to fall.
  if (scene.control != "torque")
    if (const auto weakness =
            robot::too_weak_to_hold(description, control->robot().model(),
                                    control->robot().positions(), world.settings().gravity))
      diagnostics.warning(scene.where, *weakness);
  return control;
}

}  // namespace pedicel::simulation
