#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/world/scene.h"
#include "engine/world/sim_world.h"
#include "plugins/coupling/collider.h"
#include "plugins/plant/plant_file.h"
#include "plugins/simulation/measurements.h"
#include "plugins/simulation/plants/cutting.h"
#include "plugins/simulation/plants/gentleness.h"
#include "plugins/simulation/plants/plant_info.h"
#include "plugins/simulation/plants/scene_loads.h"
#include "plugins/simulation/plants/scene_ties.h"
#include "plugins/simulation/plants/wind_field.h"
#include "plugins/simulation/robot_control.h"
#include "plugins/simulation/simulation_options.h"

namespace pedicel::simulation {

struct SceneAssets;
class GivingRobot;
class HeldOrgans;
class SceneContacts;
class Instrument;
class Instruments;

/// A scene brought to life: Bullet's world, the robot, the plants and what they feel of each other.
class Simulation {
 public:
  /// Throws InvalidFile with every fault found, before anything runs.
  Simulation(const world::Scene& scene, const SimulationOptions& options);
  /// One of several worlds of a scene; each keeps the assets alive.
  explicit Simulation(std::shared_ptr<const SceneAssets> assets);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  const world::WorldReport& step() { return world_.step(); }

  /// Goes on with the constants of other assets (stiffness, mass, thresholds, solver and contact
  /// settings); loads, bodies and robot stay. Throws UsageError where can_change_to() is false.
  void change_to(std::shared_ptr<const SceneAssets> assets);
  /// Whether these assets differ from its own in constants only.
  bool can_change_to(const SceneAssets& assets) const;
  const std::shared_ptr<const SceneAssets>& assets() const { return assets_; }

  const world::Scene& scene() const { return scene_; }
  world::SimWorld& world() { return world_; }
  const world::SimWorld& world() const { return world_; }
  const SceneTies& ties() const { return *ties_; }
  const Cutting& cutting() const { return *cutting_; }
  Cutting& cutting() { return *cutting_; }
  const cosserat::RodSystem& rods() const { return *rods_; }
  /// To act on the plants between two steps.
  cosserat::RodSystem& rods() { return *rods_; }
  const std::vector<PlantInfo>& plants() const;
  const PlantStep& plant_step() const;
  const coupling::ColliderSet& colliders() const;
  const Measurements& measurements() const { return *measurements_; }
  Measurements& measurements() { return *measurements_; }
  /// How gently its plants were handled so far.
  const Gentleness& gentleness() const { return *gentleness_; }
  /// What plants touch, and what they exert on the robot.
  const SceneContacts& contacts() const { return *contacts_; }
  /// Null where no joint gives way.
  const GivingRobot* giving() const { return giving_.get(); }
  /// Of the scene, in its order.
  const std::vector<std::unique_ptr<Instrument>>& instruments() const;
  /// Null where the scene has no robot.
  const RobotControl* robot() const { return robot_.get(); }
  RobotControl* robot() { return robot_.get(); }
  /// What a user should know and that stops nothing, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Robot joints, rods and rigid bodies, bit by bit.
  std::uint64_t state_hash() const;

 private:
  void add_plants(Diagnostics& diagnostics);
  void add_bodies();
  void add_robot(Diagnostics& diagnostics);

  std::shared_ptr<const SceneAssets> first_assets_;  // that it was built from, once others count
  std::shared_ptr<const SceneAssets> assets_;        // whose constants count
  const world::Scene& scene_;
  world::SimWorld world_;
  std::unique_ptr<cosserat::RodSystem> rods_;
  std::unique_ptr<RobotControl> robot_;
  std::unique_ptr<GivingRobot> giving_;  // null: no joint gives way
  std::unique_ptr<HeldOrgans> held_;     // null: what it holds was not recorded
  std::unique_ptr<SceneLoads> loads_;
  std::unique_ptr<SceneTies> ties_;
  std::unique_ptr<Cutting> cutting_;
  std::unique_ptr<WindField> wind_;  // null where there is none
  std::unique_ptr<SceneContacts> contacts_;
  std::unique_ptr<Measurements> measurements_;
  std::unique_ptr<Gentleness> gentleness_;
  std::unique_ptr<Instruments> instruments_;
  std::vector<std::string> notes_;
};

}  // namespace pedicel::simulation
