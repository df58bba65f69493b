#include "plugins/simulation/gripper_step.h"

#include <algorithm>
#include <cmath>

#include "plugins/simulation/colliders.h"

namespace pedicel::simulation {

namespace {

/// m or rad: farther than this nothing pushes a joint back in one step.
constexpr double farthest_back = 1.0;
/// N and N m, of a gripper that states no effort.
constexpr double own_force = 100.0, own_torque = 10.0;

double own_effort(const robot::RobotDescription& robot, const std::string& joint) {
  const robot::JointType type = robot.joints[robot.joint(joint)].type;
  return type == robot::JointType::prismatic ? own_force : own_torque;
}

}  // namespace

GripperStep::GripperStep(RobotControl& robot, coupling::ColliderSet& colliders)
    : robot_(robot), colliders_(colliders), drive_(colliders.add_drive()) {
  const robot::KinematicModel& model = robot_.robot().model();
  const int joint = robot_.gripper();
  // Of all joints that follow the one that is driven, as its motor feels it.
  double friction = 0.0;
  for (const robot::KinematicModel::Element& element : model.elements()) {
    if (element.dof != joint) continue;
    const robot::Joint& moves = robot_.description().joints[element.joint];
    friction += std::abs(element.multiplier) * moves.friction;
    // The fingers hang on what carries the driven one.
    if (!moves.mimic) palm_ = element.parent;
  }
  const double limit = robot_.robot().motors().effort_limit(joint);
  const double effort =
      std::isfinite(limit) ? limit : own_effort(robot_.description(), model.joint_names()[joint]);
  // Closing, friction takes from the motor; held open, it helps.
  now_.press = std::max(0.0, effort - friction);
  now_.hold = effort + friction;
  for (int c = 0; c < colliders_.size(); ++c) {
    const coupling::Collider& collider = colliders_.collider(c);
    // The fingers, and whatever is fixed to them.
    if (collider.body == robot_body && model.moves(joint, collider.link)) pressed_.push_back(c);
  }
  now_.reference = now_.start = now_.aim = robot_.robot().positions()[joint];
  tell_colliders();
}

// Where it was stopped, it is looked at from where it stands: Bullet has moved it on, perhaps to
// the other side of what it holds.
void GripperStep::begin(double dt) {
  robot::Robot& robot = robot_.robot();
  const int joint = robot_.gripper();
  now_.start = robot_.start_of_step()[joint];
  now_.aim = robot.positions()[joint];
  if (was_stopped_) robot.place_joint(joint, now_.start, (now_.aim - now_.start) / dt);
  now_.reference = robot.positions()[joint];
  tell_colliders();
}

void GripperStep::tell_colliders() {
  const robot::Robot& robot = robot_.robot();
  const int joint = robot_.gripper();
  // Limits bound how far a plant may push it back.
  now_.lower = std::max(robot.model().lower()[joint], now_.start - farthest_back);
  now_.upper = std::min(robot.model().upper()[joint], now_.start + farthest_back);
  colliders_.set_drive(drive_, now_);
  for (const int c : pressed_) {
    const int link = colliders_.collider(c).link;
    // At the world's origin, since a drive tells its motion as a twist there.
    const Vec3 origin_L = robot.link_poses()[link].inverse() * Vec3(0, 0, 0);
    robot.model().jacobian(robot.link_poses(), link, origin_L, jacobian_);
    colliders_.press(c, drive_, jacobian_.col(joint).head<3>(), jacobian_.col(joint).tail<3>());
  }
}

// Plants that it presses at once do not know of each other within a step: the one that stops it
// first counts.
void GripperStep::end(double dt) {
  robot::Robot& robot = robot_.robot();
  const int joint = robot_.gripper();
  double position = now_.aim, load = 0.0;
  for (const coupling::ColliderSource* source : sources_) {
    const cosserat::DriveEnd& end = source->drive_ends()[drive_];
    // Loads add up, wherever it stops.
    load += end.load;
    if (std::abs(end.position - now_.aim) > std::abs(position - now_.aim)) position = end.position;
  }
  // One that readings lead is told where it was stopped, and not where it was told to go.
  was_stopped_ = position != now_.aim || (robot_.led_by_readings() && load != 0.0);
  if (was_stopped_ || position != now_.reference)
    robot.place_joint(joint, position, (position - now_.start) / dt);
  if (load != 0.0) robot.add_motor_load(joint, load);
  if (contacts_) push_palm();
}

// Whatever the motors can bear moves nothing: they know of it (Robot, "Control"). A moment is
// handed on as two forces.
void GripperStep::push_palm() {
  robot::Robot& robot = robot_.robot();
  for (const int c : pressed_) {
    const coupling::ContactSum& sum = contacts_->colliders()[c];
    if (sum.contacts == 0) continue;
    robot.add_external_force(palm_, sum.force_W, sum.place_W);
    if (sum.moment_W.isZero(0.0)) continue;
    const Vec3 arm_W = sum.moment_W.unitOrthogonal();
    const Vec3 pair_W = 0.5 * sum.moment_W.cross(arm_W);
    robot.add_external_force(palm_, pair_W, sum.place_W + arm_W);
    robot.add_external_force(palm_, -pair_W, sum.place_W - arm_W);
  }
}

}  // namespace pedicel::simulation
