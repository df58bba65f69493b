#pragma once

#include <memory>
#include <vector>

#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/coupling/blade_source.h"
#include "plugins/coupling/collider_source.h"
#include "plugins/coupling/coupling_settings.h"
#include "plugins/simulation/giving_robot.h"
#include "plugins/simulation/gripper_step.h"
#include "plugins/simulation/plants/plant_step.h"
#include "plugins/simulation/reaction.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

struct SceneAssets;

/// What the plants of a scene touch: ground, bodies, robot, themselves. Plants within a step, and
/// with two-way coupling what acts back.
class SceneContacts {
 public:
  /// Where all things stand now. `robot` and `giving` may be null; keeps references to all but the
  /// assets, whose scene must outlive it. Warns of what overlaps from the start, and lets it alone.
  SceneContacts(const SceneAssets& assets, world::SimWorld& world, cosserat::RodSystem& rods,
                RobotControl* robot, GivingRobot* giving, Diagnostics& diagnostics);

  /// Adds itself to the world's step: the gripper goes back to where it was stopped, plants move,
  /// the gripper goes to where it stands.
  void join();
  /// Friction, stiffness and what else may change while it runs.
  void change_settings(const coupling::CouplingSettings& settings);

  /// A body of the world that has come off a plant: from the next step on plants feel it, where
  /// they touch each other.
  void add_fallen(int plant, int body);

  const coupling::ColliderSet& colliders() const { return colliders_; }
  const PlantStep& plant_step() const { return *plant_step_; }

 private:
  void add_colliders(const SceneAssets& assets);
  void add_grip(const SceneAssets& assets);
  void add_blades(const SceneAssets& assets, int plant);
  void add_sources(const SceneAssets& assets, int plant, Diagnostics& diagnostics);
  coupling::ColliderSource& add_source(const SceneAssets& assets, int plant);
  void act_back(const coupling::ContactReport& contacts);
  SourcePosition place_of(const coupling::Collider& collider) const;
  Pose link_pose(const coupling::Collider& collider) const;

  const world::Scene& scene_;
  world::SimWorld& world_;
  cosserat::RodSystem& rods_;
  RobotControl* robot_;
  coupling::ColliderSet colliders_;
  GivingRobot* giving_;
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
