#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// A run's state as `--save-state` writes it. Bullet keeps history in many places (warm starting,
/// contact points, sleeping pairs) and hands none of it out, so what is kept is how to come there
/// again: the steps of the same scene, which are the same bits every time, and the hash that proves
/// it.
struct RunState {
  std::string program;      ///< "0.1.0 (a28fe29)"
  std::string scene;        ///< its name
  std::uint64_t model = 0;  ///< of what the scene is made of: model_hash()
  double dt = 0.0;          ///< s
  long steps = 0;
  std::uint64_t state = 0;  ///< Simulation::state_hash()
};

RunState state_of(const simulation::Simulation& simulation, std::uint64_t model);

/// Of a simulation before its first step: its state, constants of its plants and settings.
std::uint64_t model_hash(const simulation::Simulation& simulation);

/// Throws io::WriteError.
void write_state(const std::filesystem::path& path, const RunState& state);
/// Throws InvalidFile where it is no state, is cut off, or is of another version.
RunState read_state(const std::filesystem::path& path);

/// Brings a simulation that has not begun to a state. Throws InvalidFile where the state is of
/// another scene or does not come out bit by bit, Stopped where that is asked for.
void go_to_state(simulation::Simulation& simulation, const RunState& state,
                 const std::filesystem::path& path);

}  // namespace pedicel::app
