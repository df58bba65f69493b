#pragma once

#include <vector>

#include "engine/world/sim_world.h"
#include "plugins/coupling/collider_source.h"
#include "plugins/coupling/contact_report.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

/// The robot's gripper against plants, in both coupling directions: its joint presses with at most
/// its motor's effort, and stands where that balances what it holds (plugins/coupling/README.md,
/// "Grips"). Bullet moves it as if no plant were there; the plants' step decides how much of that
/// way it gets. In two-way coupling the robot bears what the fingers carry from the next step on.
class GripperStep {
 public:
  /// `robot` has a gripper. Both must outlive this object. To be made before the plants' sources
  /// look at what touches from the start.
  GripperStep(RobotControl& robot, coupling::ColliderSet& colliders);
  /// Hands what the fingers carry on to the link that they hang on (two-way coupling).
  void pass_on(const coupling::ContactReport& contacts) { contacts_ = &contacts; }
  /// The contacts of one plant, which must outlive this object.
  void add(const coupling::ColliderSource& source) { sources_.push_back(&source); }

  /// To be added to the world after the robot's reader and before the plants.
  world::Participant& before() { return before_; }
  /// To be added after the plants.
  world::Participant& after() { return after_; }

 private:
  template <void (GripperStep::*function)(double dt)>
  class Part : public world::Participant {
   public:
    explicit Part(GripperStep& grip) : grip_(grip) {}
    world::Phase phase() const override { return world::Phase::plants; }
    void act(world::SimWorld& world, world::WorldReport&) override {
      (grip_.*function)(world.dt());
    }

   private:
    GripperStep& grip_;
  };
  void begin(double dt);
  void end(double dt);
  void tell_colliders();
  void push_palm();

  RobotControl& robot_;
  coupling::ColliderSet& colliders_;
  std::vector<const coupling::ColliderSource*> sources_;
  Part<&GripperStep::begin> before_{*this};
  Part<&GripperStep::end> after_{*this};
  const coupling::ContactReport* contacts_ = nullptr;
  int drive_ = -1;
  int palm_ = 0;              // link
  std::vector<int> pressed_;  // colliders
  robot::Jacobian jacobian_;
  cosserat::ContactDrive now_;
  bool was_stopped_ = false;  // by what it pressed, in the step before
};

}  // namespace pedicel::simulation
