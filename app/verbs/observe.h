#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// What the command line says of `pedicel observe`.
struct ObserveArguments {
  std::string model;            ///< a plant file, or a scene or experiment whose plant is meant
  std::string plant;            ///< name of the scene's plant; empty: its only one
  std::string like;             ///< the experiment to repeat
  std::string out;              ///< folder
  std::uint64_t seed = 1;       ///< of the noise
  double noise_position = 0.0;  ///< m, standard deviation
  double noise_force = 0.0;     ///< N, standard deviation
  double noise_moment = 0.0;    ///< N m, standard deviation
  double noise_colour = 0.0;    ///< 1, correlation of a sample's noise with the one before: AR(1)
  double distance = 0.005;      ///< m between nodes
  double dt = 1.0 / 1920;       ///< s
  int threads = 1;
  std::vector<std::string> set;  ///< effects as in a file, {name: ..., ...}: simulated, not written
};

void add_observe_options(CLI::App& observe, ObserveArguments& arguments);

/// Simulates the trials of `like` with another plant and writes what its instruments would have
/// reported as an experiment folder: the plant given, with its effects, and the drives, markers,
/// sample times and gaps of `like`. A scene's plant is taken with the scene's `set:`; its place and
/// gravity are those of `like`, and its robot is not there. Returns the exit code. Throws
/// InvalidFile, UsageError, UnstableWorld, io::WriteError.
int observe_verb(const ObserveArguments& arguments);

/// The same without files: `like` with what the instruments would have reported. Where a table of
/// `like` has no sample at all, it is a plan, and all of it is filled.
discrepancy::Experiment observed(const ObserveArguments& arguments, discrepancy::Experiment like);

/// What `format:` of a file says, "pedicel-scene" and its like, empty where it is no YAML map that
/// has it; of a folder, that it is an experiment.
/// Throws InvalidFile.
std::string format_of(const std::filesystem::path& file);

/// The scene to simulate: the file itself, or the scene of an experiment. Throws InvalidFile.
std::filesystem::path scene_of(const std::filesystem::path& model);

/// Adds noise of the given marginal standard deviation to each column, white or AR(1); gaps stay.
void add_noise(discrepancy::Samples& samples, double deviation, double colour, std::uint64_t seed);

}  // namespace pedicel::app
