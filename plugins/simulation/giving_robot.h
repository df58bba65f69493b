#pragma once

#include <memory>

#include "plugins/discrepancy/scene/giving_joints.h"
#include "plugins/discrepancy/scene/giving_source.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

/// A robot whose joints give way between its encoders and its links (the effect `reaction`). Bullet
/// moves the motors' side, as if there were no plants; the links stand beyond it by what plants
/// exert on them.
class GivingRobot {
 public:
  /// Keeps a reference to the robot. `dt`: s, of a step.
  GivingRobot(RobotControl& robot, const discrepancy::SceneState& state, double dt);

  /// Before the robot is led: Bullet has the motors' side only.
  world::Participant& before() { return before_; }
  /// After Bullet's part of the step: links go to where the forces of the step before put them.
  world::Participant& after() { return after_; }
  /// Where they are, for the plants' contacts.
  const discrepancy::GivingArm& arm() const { return arm_; }
  /// After the plants: what these exert on the links, as J^T has it at the joints (N m).
  void act(const Eigen::VectorXd& effort);
  /// How far joints gave way, how fast, and its change: rad, rad/s, rad/s2, one after another.
  Eigen::RowVectorXd row() const { return joints_.row(); }

 private:
  class Part : public world::Participant {
   public:
    Part(world::Phase phase, GivingRobot& owner, void (GivingRobot::*task)())
        : phase_(phase), owner_(owner), task_(task) {}
    world::Phase phase() const override { return phase_; }
    void act(world::SimWorld&, world::WorldReport&) override { (owner_.*task_)(); }

   private:
    world::Phase phase_;
    GivingRobot& owner_;
    void (GivingRobot::*task_)();
  };

  void go_back();
  void give_way();

  RobotControl& robot_;
  double stiffness_, damping_;  // N m/rad, N m s/rad
  discrepancy::Arm model_;
  discrepancy::GivingJoints joints_;
  discrepancy::GivingArm arm_;
  Eigen::VectorXd q_, qd_;  // of the motors' side
  Part before_, after_;
};

}  // namespace pedicel::simulation
