#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/world/recorder.h"
#include "engine/world/sim_world.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/coupling/collider.h"
#include "plugins/coupling/contact_report.h"

namespace pedicel::simulation {

/// A fruit that came off: what broke, and the rigid body that it is now.
struct Detached {
  int plant = 0;  ///< index into the RodSystem
  cosserat::DetachEvent event;
  std::string fruit;  ///< "truss/fruit_3"
  int body = -1;      ///< index into the SimWorld
  Pose tool;          ///< X_W of the gripper then; NaN where there is none
};

/// Plants within a step: contact fields go to where Bullet has moved the links, rods move, fruits
/// that came off go on as rigid bodies with the velocity they had.
class PlantStep : public world::Participant {
 public:
  /// Gives the pose X_WL of a collider's link at the end of Bullet's part of the step.
  using LinkPose = std::function<Pose(const coupling::Collider&)>;

  PlantStep(cosserat::RodSystem& rods, coupling::ColliderSet& colliders, LinkPose link_pose);

  /// Gives the gripper's pose for the record of a break.
  void set_tool(std::function<Pose()> tool) { tool_ = std::move(tool); }
  /// Hands the reaction of the plants to the links (two-way coupling), after every step.
  void set_reaction(std::function<void(const coupling::ContactReport&)> reaction) {
    reaction_ = std::move(reaction);
  }

  /// Hears of each fruit that came off, when it is a body of the world.
  void set_released(std::function<void(const Detached&)> released) {
    released_ = std::move(released);
  }

  world::Phase phase() const override { return world::Phase::plants; }
  void act(world::SimWorld& world, world::WorldReport& report) override;

  const coupling::ContactReport& contacts() const { return contacts_; }
  const std::vector<Detached>& detached() const { return detached_; }

 private:
  void move_colliders();
  void sum_up(const Vec3& gravity, world::WorldReport& report);
  void judge(int plant, world::WorldReport& report) const;
  void release(world::SimWorld& world, int plant, const cosserat::DetachEvent& event);

  cosserat::RodSystem& rods_;
  coupling::ColliderSet& colliders_;
  LinkPose link_pose_;
  std::function<Pose()> tool_;
  std::function<void(const coupling::ContactReport&)> reaction_;
  std::function<void(const Detached&)> released_;
  coupling::ContactReport contacts_;
  std::vector<Pose> poses_;
  std::vector<Detached> detached_;
  struct Tally {
    int rough_steps = 0;  // in a row that did not converge
    double energy = 0.0;  // J
  };
  std::vector<Tally> tallies_;  // one a plant
};

/// "truss/fruit_3": a fruit's name in scenes, logs and events.
std::string fruit_name(const cosserat::RodModel& model, int fruit);

}  // namespace pedicel::simulation
