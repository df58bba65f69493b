#pragma once

#include <string>

#include "engine/ros_messages/simulation_messages.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// A scene with what clients have put into it, taken out of it or moved. It is a plan: nothing is
/// built of it here, and each function leaves it as it was where it says no.
class SceneEdits {
 public:
  SceneEdits(const world::Scene& scene, const simulation::SimulationOptions& options);

  const world::Scene& scene() const { return scene_; }
  const simulation::SimulationOptions& options() const { return options_; }
  /// As the file says it.
  void reset();
  /// Goes on with another plan for the same file.
  void take(const SceneEdits& other);
  bool is_as_given() const { return !edited_; }

  /// Adds a plant (the file format pedicel-plant) or a body (an entry of a scene's `bodies`, as
  /// YAML), from a file or from text.
  ros::SpawnEntity::Response spawn(const ros::SpawnEntity::Request& request);
  /// Takes a plant or a body out.
  ros::SimulationResult remove(const std::string& entity);
  /// Moves a plant, a body or the robot; a body that moves may have a velocity at time 0.
  ros::SimulationResult set_state(const ros::SetEntityState::Request& request);

 private:
  bool is_taken(const std::string& name) const;
  std::string free_name(const std::string& wanted) const;
  ros::SimulationResult add(const std::string& name, const std::string& text,
                            const std::filesystem::path& file, const Pose& pose);

  const world::Scene first_scene_;
  const simulation::SimulationOptions first_options_;
  world::Scene scene_;
  simulation::SimulationOptions options_;
  bool edited_ = false;
};

}  // namespace pedicel::app
