#include "app/session/live/pick_program.h"

#include <algorithm>
#include <cmath>

#include "app/session/live/robot_goal.h"
#include "engine/core/check.h"
#include "engine/robot/cartesian_path.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::app {

namespace {

constexpr double way_in = 0.1;       // m, before the fruit
constexpr double way_up = 0.34;      // m, of the usual pull
constexpr double way_back = 0.04;    // m
constexpr double squeeze = 0.85;     // 1, of the radius at which the fingers are to stand
constexpr double clearance = 0.006;  // m, about the fruit with the gripper open

/// Level, from the robot's base to the fruit.
Vec3 towards(const Snapshot& now, const Vec3& place_W) {
  Vec3 way = place_W - now.assets->scene.robot->base.position;
  way.z() = 0.0;
  return way.norm() > 1e-3 ? Vec3(way.normalized()) : Vec3(Vec3::UnitX());
}

int gripper_of(const Snapshot& now, const robot::KinematicModel& model) {
  const std::string& name = now.assets->scene.robot->gripper;
  const int dof = name.empty() ? -1 : model.joint_index(name);
  if (dof < 0)
    throw UsageError("the robot has no gripper, expected one (see: set robot gripper JOINT)");
  return dof;
}

/// The axis along which the fingers close, in the tool's frame.
Vec3 closing_axis(const Snapshot& now, const robot::KinematicModel& model, int gripper) {
  const Eigen::VectorXd& q = start_of(now.robot);
  std::vector<Pose> links;
  model.link_poses(q, links);
  const Quat to_tool = links[static_cast<std::size_t>(now.robot.tool_link)].rotation.conjugate();
  for (const robot::KinematicModel::Element& element : model.elements()) {
    if (element.dof != gripper) continue;
    Vec3 axis = to_tool * (links[static_cast<std::size_t>(element.link)].rotation * element.axis);
    if (element.type != robot::JointType::prismatic) axis = axis.cross(Vec3::UnitZ());
    axis.z() = 0.0;
    if (axis.norm() > 1e-3) return axis.normalized();
  }
  return Vec3::UnitY();
}

/// The tool's Z axis towards the fruit, its fingers closing level: a stalk hangs from above.
Quat facing(const Vec3& approach, const Vec3& closing) {
  const Vec3 across = Vec3::UnitZ().cross(approach).normalized();
  Mat3 world, tool;
  world << across, approach.cross(across), approach;
  tool << closing, Vec3::UnitZ().cross(closing), Vec3::UnitZ();
  return Quat(Mat3(world * tool.transpose())).normalized();
}

/// The least distance (m) from the tool's place to the links that a joint moves.
double finger_distance(const Snapshot& now, const robot::KinematicModel& model,
                       const Eigen::VectorXd& q, int gripper) {
  std::vector<Pose> links;
  model.link_poses(q, links);
  const Vec3 middle =
      links[static_cast<std::size_t>(now.robot.tool_link)] * now.assets->scene.robot->tool_offset;
  double least = 1.0;
  const simulation::ShapeFields& fields = now.assets->robot_fields;
  for (std::size_t l = 0; l < fields.size(); ++l) {
    if (!model.moves(gripper, static_cast<int>(l))) continue;
    const robot::Link& link = now.assets->robot->links[l];
    for (std::size_t s = 0; s < fields[l].size(); ++s) {
      const Pose shape = links[l] * link.collisions[s].X_LC;
      least = std::min(least, fields[l][s]->distance(shape.inverse() * middle));
    }
  }
  return least;
}

}  // namespace

FruitPlace find_fruit(const Snapshot& now, const std::string& organ) {
  std::string names;
  for (const PlantSnapshot& plant : now.plants)
    for (int f = 0; f < static_cast<int>(plant.model->fruits.size()); ++f) {
      const cosserat::Fruit& fruit = plant.model->fruits[static_cast<std::size_t>(f)];
      const std::string name = simulation::fruit_name(*plant.model, f);
      const bool is_on = plant.state.alive[static_cast<std::size_t>(fruit.element)];
      if (is_on) names += (names.empty() ? "" : ", ") + name;
      if (name == organ && is_on)
        return {point_on(*plant.model, plant.state, fruit.element, fruit.back), fruit.radius};
    }
  throw UsageError("no fruit \"" + organ + "\" on a plant, expected " +
                   (names.empty() ? "one to be there" : "one of: " + names));
}

GripperPlaces gripper_places(const Snapshot& now, const robot::KinematicModel& model,
                             double radius) {
  const int gripper = gripper_of(now, model);
  const double low = model.lower()[gripper], high = model.upper()[gripper];
  if (!std::isfinite(low) || !std::isfinite(high))
    throw UsageError("the gripper's joint has no limits, expected some");
  Eigen::VectorXd q = start_of(now.robot);
  const auto distance = [&](double value) {
    q[gripper] = value;
    return finger_distance(now, model, q, gripper);
  };
  const bool opens_up = distance(high) >= distance(low);
  const double open = opens_up ? high : low, closed = opens_up ? low : high;
  // From open on: where the fingers stand that far off.
  const auto place = [&](double off) {
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i) {
      const double value = open + (closed - open) * i / steps;
      if (distance(value) <= off) return value;
    }
    return closed;
  };
  if (distance(open) < radius)
    throw UsageError("the gripper opens to " + std::to_string(2e3 * distance(open)).substr(0, 4) +
                     " mm, expected more than the fruit's " +
                     std::to_string(2e3 * radius).substr(0, 4) + " mm");
  return {place(radius + clearance), place(squeeze * radius)};
}

robot::Trajectory pick_program(const Snapshot& now, const FruitPlace& fruit, const Vec3& pull_W) {
  const robot::KinematicModel model = kinematics_of(now);
  const world::SceneRobot& scene = *now.assets->scene.robot;
  const GripperPlaces places = gripper_places(now, model, fruit.radius);
  const Vec3 approach = towards(now, fruit.middle_W);
  const Quat turn = facing(approach, closing_axis(now, model, gripper_of(now, model)));
  const auto waypoint = [&](double time, const Vec3& tool_W, double gripper) {
    robot::Waypoint one;
    one.time = time;
    one.tool = now.assets->robot->links[static_cast<std::size_t>(now.robot.tool_link)].name;
    one.position_W = tool_W - turn * scene.tool_offset;
    one.orientation_W = turn;
    one.joints[scene.gripper] = gripper;
    return one;
  };
  robot::PathSettings settings;
  settings.ik.position_tolerance = 1e-3;  // of no matter to a fruit
  settings.ik.rotation_tolerance = 1e-2;
  std::string why;
  for (double slow = 1.0; slow < 8.0; slow *= 1.5) {
    const std::vector<robot::Waypoint> way = {
        waypoint(1.2 * slow, fruit.middle_W - way_in * approach, places.open),
        waypoint(2.0 * slow, fruit.middle_W, places.open),
        waypoint(2.0 * slow + 0.4, fruit.middle_W, places.shut),
        waypoint(2.0 * slow + 0.4 + 1.5 * slow, fruit.middle_W + pull_W, places.shut)};
    Diagnostics diagnostics;
    robot::Trajectory program =
        robot::plan_cartesian(model, way, start_of(now.robot), settings, diagnostics);
    if (!diagnostics.has_errors()) return program;
    why = diagnostics.all().front().what;
  }
  throw UsageError("the robot cannot take it off: " + why);
}

robot::Trajectory usual_pick(const Snapshot& now, const FruitPlace& fruit) {
  const Vec3 up = Vec3::UnitZ(), back = -towards(now, fruit.middle_W);
  const Vec3 steep = way_up * up + way_back * back, slanting = way_up * (up + back).normalized();
  std::string why;
  for (const double share : {1.0, 0.75, 0.5})
    for (const Vec3& pull_W : {steep, slanting}) {
      try {
        return pick_program(now, fruit, share * pull_W);
      } catch (const UsageError& fault) {
        why = fault.what();
      }
    }
  throw UsageError(why);
}

}  // namespace pedicel::app
