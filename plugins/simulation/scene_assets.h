#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/cosserat/solver/rod_solver.h"
#include "plugins/discrepancy/scene/run_effects.h"
#include "plugins/simulation/colliders.h"
#include "plugins/simulation/plants/plant_info.h"
#include "plugins/simulation/robot_control.h"
#include "plugins/simulation/simulation_options.h"

namespace pedicel::simulation {

/// What the worlds of a scene only read: loaded and built once, however many worlds there are.
/// Never changes, so worlds on several threads may share it.
struct SceneAssets {
  /// Throws InvalidFile with every fault of the scene's settings, plants and robot.
  SceneAssets(const world::Scene& scene, const SimulationOptions& options);
  /// Of parts that are there already: whoever calls fills in the rest.
  explicit SceneAssets(world::Scene parts_of) : scene(std::move(parts_of)) {}

  world::Scene scene;
  cosserat::RodSettings rods;
  coupling::CouplingSettings coupling;
  std::vector<cosserat::RodModel> models;  ///< as built; a world breaks fruits off a copy
  std::vector<PlantInfo> plants;           ///< one a model
  std::vector<cosserat::RodState> states;  ///< in which they begin; empty: as drawn
  std::optional<robot::RobotDescription> robot;
  ShapeFields robot_fields;  ///< empty where there is no robot
  /// What its `effects:` change, where it has some; `coupling`, `models` and `robot` have that
  /// already.
  std::optional<discrepancy::RunEffects> effects;
  /// As its file says, where effects change it: programs are planned for it.
  std::optional<robot::RobotDescription> believed;
  /// What was recorded leads the robot, and not its program; none: the program.
  JointReadings readings;
  /// Fruits that come off feel a robot that readings lead, too. It takes Bullet's time.
  bool loose_fruits = false;
  std::vector<Grasp> grasps;       ///< organs that links take hold of, likewise
  std::vector<std::string> notes;  ///< what a user should know and that stops nothing

 private:
  void read_effects(Diagnostics& diagnostics);
};

}  // namespace pedicel::simulation
