#include "plugins/discrepancy/scene/state_changes.h"

#include "engine/robot/kinematics.h"
#include "plugins/cosserat/model/rotation.h"

namespace pedicel::discrepancy {

namespace {

Quat turned_by(const Vec3& rotation) {
  const double angle = rotation.norm();
  return angle > 0.0 ? Quat(Eigen::AngleAxisd(angle, rotation / angle)) : Quat::Identity();
}

robot::Inertial with_mass(const robot::Inertial& link, double mass, const Vec3& centre) {
  robot::Inertial sum;
  sum.mass = link.mass + mass;
  sum.com_L = (link.mass * link.com_L + mass * centre) / sum.mass;
  const auto about = [&](double m, const Vec3& p) -> Mat3 {
    const Mat3 s = skew(p - sum.com_L);
    return -m * s * s;
  };
  sum.inertia = link.inertia + about(link.mass, link.com_L) + about(mass, centre);
  return sum;
}

robot::Joint& joint_of(robot::RobotDescription& robot, const robot::KinematicModel& model,
                       int dof) {
  const std::string& name = model.joint_names()[static_cast<std::size_t>(dof)];
  return robot.joints[static_cast<std::size_t>(robot.joint(name))];
}

}  // namespace

robot::RobotDescription with_tool(robot::RobotDescription robot, int tool,
                                  const SceneState& state) {
  for (robot::Joint& joint : robot.joints) {
    if (joint.child != tool) continue;
    // In the axes of the carrying link.
    joint.X_PJ.position += state.tool_offset;
    joint.X_PJ.rotation = turned_by(state.tool_rotation) * joint.X_PJ.rotation;
  }
  robot::Inertial& hand = robot.links[static_cast<std::size_t>(tool)].inertial;
  if (state.payload > 0.0) hand = with_mass(hand, state.payload, state.payload_centre);
  return robot;
}

robot::RobotDescription with_friction(robot::RobotDescription robot, const SceneState& state) {
  const robot::KinematicModel model(robot);
  for (int dof = 0; dof < model.dofs(); ++dof) {
    joint_of(robot, model, dof).friction += state.coulomb[dof];
    joint_of(robot, model, dof).damping += state.viscous[dof];
  }
  return robot;
}

robot::RobotDescription with_joint_offsets(robot::RobotDescription robot, const SceneState& state) {
  const robot::KinematicModel model(robot);
  for (int dof = 0; dof < model.dofs(); ++dof) {
    if (state.joint_offset[dof] == 0.0) continue;
    robot::Joint& joint = joint_of(robot, model, dof);
    const Vec3 along = state.joint_offset[dof] * joint.axis;
    if (joint.type == robot::JointType::prismatic)
      joint.X_PJ.position += joint.X_PJ.rotation * along;
    else
      joint.X_PJ.rotation = joint.X_PJ.rotation * turned_by(along);
  }
  return robot;
}

void change_plant(cosserat::RodModel& model, const SceneState::Plant& state) {
  for (cosserat::Fruit& fruit : model.fruits) {
    fruit.density *= state.fruit_mass;
    for (double* limit :
         {&fruit.thresholds.stretch, &fruit.thresholds.bend, &fruit.thresholds.force,
          &fruit.thresholds.moment, &fruit.thresholds.torsion})
      *limit *= state.threshold;
  }
  if (state.fruit_mass == 1.0) return;
  for (const cosserat::Fruit& fruit : model.fruits) cosserat::lump_inertia(model, fruit.element);
}

Pose moved_plant(const Vec3& root_W, const SceneState::Plant& state) {
  const Quat turn(Eigen::AngleAxisd(state.yaw, Vec3::UnitZ()));
  return {root_W + state.offset - turn * root_W, turn};
}

}  // namespace pedicel::discrepancy
