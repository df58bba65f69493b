#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/ros_messages/simulation_messages.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// A thing of a simulation as simulation_interfaces names them: the robot, a plant, a fruit
/// ("truss/fruit_1", on its plant or off it), a rigid body.
struct Entity {
  std::string name;
  std::uint8_t category = ros::EntityCategory::object;
  ros::EntityState state;  ///< in the world; accelerations are not told
};

std::vector<Entity> entities_of(const simulation::Simulation& simulation);

/// Those that a filter leaves: a regular expression (POSIX extended) of the whole name, categories.
/// Nothing, with the reason in `result`, where the filter cannot be kept to.
std::optional<std::vector<Entity>> filtered(std::vector<Entity> all,
                                            const ros::EntityFilters& filters,
                                            ros::SimulationResult& result);

}  // namespace pedicel::app
