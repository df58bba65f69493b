#include "plugins/discrepancy/scene/arm.h"

#include "engine/robot/inertial_sum.h"
#include "plugins/discrepancy/scene/state_changes.h"

namespace pedicel::discrepancy {

namespace {

robot::RobotDescription changed(const SceneExperiment& experiment, const SceneState& state) {
  if (!experiment.scene.robot) return experiment.robot;
  return with_tool(experiment.robot, tool_link(*experiment.scene.robot, experiment.robot), state);
}

}  // namespace

int tool_link(const world::SceneRobot& scene, const robot::RobotDescription& robot) {
  const int named = robot.link(scene.tool.empty() ? "tool" : scene.tool);
  return named >= 0 ? named : static_cast<int>(robot.links.size()) - 1;
}

Arm::Arm(const SceneExperiment& experiment, const SceneState& state)
    : description_(changed(experiment, state)),
      model_(description_, experiment.scene.robot ? experiment.scene.robot->base : Pose{}) {
  tool_ = experiment.scene.robot ? tool_link(*experiment.scene.robot, description_) : 0;
  beyond_.resize(description_.links.size());
  // Parents come before their children.
  for (auto element = model_.elements().rbegin(); element != model_.elements().rend(); ++element) {
    std::vector<int>& own = beyond_[static_cast<std::size_t>(element->link)];
    own.insert(own.begin(), element->link);
    if (element->parent < 0) continue;
    std::vector<int>& parent = beyond_[static_cast<std::size_t>(element->parent)];
    parent.insert(parent.end(), own.begin(), own.end());
  }
  start_ = model_.neutral();
  if (experiment.scene.robot)
    for (const auto& [joint, value] : experiment.scene.robot->joints)
      if (const int dof = model_.joint_index(joint); dof >= 0) start_[dof] = value;
}

Eigen::Matrix<double, 6, 1> Arm::own_wrench(int link, const JointPath::Point& motion,
                                            const Vec3& gravity) const {
  // Accelerations by the recursion of the Newton-Euler algorithm, in world axes.
  std::vector<Pose> poses;
  model_.link_poses(motion.q, poses);
  std::vector<robot::Twist> twists;
  model_.link_velocities(poses, motion.qd, twists);
  struct Acceleration {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  };
  std::vector<Acceleration> all(poses.size());
  for (const robot::KinematicModel::Element& e : model_.elements()) {
    if (e.parent < 0) continue;
    const auto l = static_cast<std::size_t>(e.link), p = static_cast<std::size_t>(e.parent);
    const Vec3 r = poses[l].position - poses[p].position;
    const Vec3 w = twists[p].angular;
    all[l].angular = all[p].angular;
    all[l].linear = all[p].linear + all[p].angular.cross(r) + w.cross(w.cross(r));
    if (e.dof < 0) continue;
    // The child's frame turns about its own joint axis, which has the same place in both.
    const Vec3 axis = poses[l].rotation * e.axis;
    const double v = e.multiplier * motion.qd[e.dof], a = e.multiplier * motion.qdd[e.dof];
    if (e.type == robot::JointType::prismatic) {
      all[l].linear += axis * a + 2.0 * w.cross(axis * v);
    } else {
      all[l].angular += axis * a + w.cross(axis * v);
    }
  }
  const auto own = static_cast<std::size_t>(link);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (const int beyond : beyond_[own]) {
    const auto b = static_cast<std::size_t>(beyond);
    const robot::Inertial& body = description_.links[b].inertial;
    const Vec3 arm = poses[b].rotation * body.com_L;
    const Vec3 w = twists[b].angular, dw = all[b].angular;
    const Vec3 acceleration = all[b].linear + dw.cross(arm) + w.cross(w.cross(arm));
    const Vec3 f = body.mass * (gravity - acceleration);
    const Mat3 r = poses[b].rotation.toRotationMatrix();
    const Mat3 inertia = r * body.inertia * r.transpose();
    const Vec3 m = -(inertia * dw + w.cross(inertia * w));
    force += f;
    moment += m + (poses[b].position + arm - poses[own].position).cross(f);
  }
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << poses[own].rotation.conjugate() * force, poses[own].rotation.conjugate() * moment;
  return wrench;
}

Eigen::Matrix<double, 6, 1> Arm::own_wrench(int link, const JointPath::Point& begin,
                                            const JointPath::Point& end, double dt,
                                            const Vec3& gravity) const {
  std::vector<Pose> poses, before;
  std::vector<robot::Twist> twists, twists_before;
  model_.link_poses(begin.q, before);
  model_.link_velocities(before, begin.qd, twists_before);
  model_.link_poses(end.q, poses);
  model_.link_velocities(poses, end.qd, twists);
  const Pose& own = poses[static_cast<std::size_t>(link)];
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (const int beyond : this->beyond(link)) {
    const auto b = static_cast<std::size_t>(beyond);
    const robot::Inertial& body = description_.links[b].inertial;
    // Of the centre's velocity, and of what turns about it.
    const auto momentum = [&](const Pose& pose, const robot::Twist& twist) {
      const Mat3 r = pose.rotation.toRotationMatrix();
      return std::pair<Vec3, Vec3>(body.mass * (twist.linear + twist.angular.cross(r * body.com_L)),
                                   r * body.inertia * r.transpose() * twist.angular);
    };
    const auto now = momentum(poses[b], twists[b]), then = momentum(before[b], twists_before[b]);
    const Vec3 f = body.mass * gravity - (now.first - then.first) / dt;
    force += f;
    moment += (poses[b] * body.com_L - own.position).cross(f) - (now.second - then.second) / dt;
  }
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << own.rotation.conjugate() * force, own.rotation.conjugate() * moment;
  return wrench;
}

}  // namespace pedicel::discrepancy
