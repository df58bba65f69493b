#pragma once

#include <memory>
#include <vector>

#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/coupling/blade_source.h"
#include "plugins/coupling/collider_source.h"
#include "plugins/coupling/coupling_settings.h"
#include "plugins/simulation/giving_robot.h"
#include "plugins/simulation/gripper_step.h"
#include "plugins/simulation/held_organs.h"
#include "plugins/simulation/plants/plant_step.h"
#include "plugins/simulation/reaction.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

struct SceneAssets;

/// What the plants of a scene touch: ground, bodies, robot, themselves. Plants within a step, and
/// with two-way coupling what acts back.
class SceneContacts {
 public:
  /// Where all things stand now. `robot`, `giving` and `held` may be null; keeps references to all
  /// but the assets, whose scene must outlive it. Stems that overlap the robot at the start lean on
  /// it; what else overlaps it warns of, and lets it alone.
  SceneContacts(const SceneAssets& assets, world::SimWorld& world, cosserat::RodSystem& rods,
                RobotControl* robot, GivingRobot* giving, HeldOrgans* held,
                Diagnostics& diagnostics);

  /// Adds itself to the world's step: the gripper goes back to where it was stopped, plants move,
  /// the gripper goes to where it stands.
  void join();
  /// Friction, stiffness and what else may change while it runs.
  void change_settings(const coupling::CouplingSettings& settings);

  /// A body of the world that has come off a plant: from the next step on plants feel it, where
  /// they touch each other.
  void add_fallen(int plant, int body);

  /// What plants exerted on links of the robot in the step that has ended, by contact and by what
  /// is held, and what that is at its joints (N m or N). Where joints give way or recorded ones
  /// lead; else empty. Where recorded ones lead, with what rigid bodies exerted.
  const std::vector<robot::LinkReaction>& link_forces() const { return link_forces_; }
  const Eigen::VectorXd& effort() const { return effort_; }

  const coupling::ColliderSet& colliders() const { return colliders_; }
  const PlantStep& plant_step() const { return *plant_step_; }

 private:
  void add_colliders(const SceneAssets& assets);
  void add_grip(const SceneAssets& assets);
  void add_blades(const SceneAssets& assets, int plant);
  void add_sources(const SceneAssets& assets, int plant, Diagnostics& diagnostics);
  /// Which shapes of a plant lean on the robot, by their index; empty: none.
  std::vector<bool> lean_on_robot(const SceneAssets& assets, int plant);
  coupling::ColliderSource& add_source(const SceneAssets& assets, int plant);
  void act_back(const coupling::ContactReport& contacts);
  void sum_up(const coupling::ContactReport& contacts);
  SourcePosition place_of(const coupling::Collider& collider) const;
  Pose link_pose(const coupling::Collider& collider) const;

  const world::Scene& scene_;
  world::SimWorld& world_;
  cosserat::RodSystem& rods_;
  RobotControl* robot_;
  coupling::ColliderSet colliders_;
  GivingRobot* giving_;
  HeldOrgans* held_;
  std::vector<robot::LinkReaction> link_forces_;
  Eigen::VectorXd effort_;
  std::vector<coupling::ColliderSource*> sources_;       // of rods_
  std::vector<discrepancy::GivingSource*> with_giving_;  // likewise; empty where nothing gives way
  std::vector<cosserat::SelfContact*> self_contacts_;
  std::vector<coupling::BladeSource*> blades_;
  std::unique_ptr<GripperStep> grip_;  // null without a gripper that its motor moves
  std::unique_ptr<PlantStep> plant_step_;
  std::unique_ptr<Reaction> reaction_;  // null where nothing feels plants
  bool touch_each_other_ = false;       // the plants
};

}  // namespace pedicel::simulation
