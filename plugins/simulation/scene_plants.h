#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/scene/run_effects.h"
#include "plugins/simulation/plants/plant_info.h"
#include "plugins/simulation/simulation_options.h"

namespace pedicel::simulation {

/// A plant of a scene, ready for the solver.
struct ScenePlantModel {
  cosserat::RodModel model;
  PlantInfo info;
};

/// A plant of a scene as a file of its own, and where it stands.
struct PlacedPlantFile {
  plant::PlantFile file;
  Pose pose;                     ///< X_WP
  std::filesystem::path source;  ///< the file that it was read from
};

/// The file that a scene's plant is read from: an absent optional one's fallback, which may be
/// empty.
std::filesystem::path source_of(const world::ScenePlant& plant);

/// Reads that file, a plant's, a skeleton table or an MTG, in the entry's unit; nothing where it is
/// faulty, or absent and optional.
std::optional<plant::PlantFile> read_scene_plant(const world::ScenePlant& plant,
                                                 Diagnostics& diagnostics);

/// Builds every plant of a scene: from plant files, MTG files and built-in reference plants, with
/// the scene's `set:` overrides and what its effects change (null: none), repeated where it says
/// so. Faults go to `diagnostics`; what is
/// worth knowing (an absent optional file) to `notes`.
///
/// Overrides: detach.stretch, .bend, .force, .moment, .torsion (all fruits),
/// material.youngs_modulus, .poisson_ratio, .density, .damping_time (the plant's number; curves
/// with one of their own keep their ratio to it), sampling.connect, sampling.distance.
std::vector<ScenePlantModel> build_plants(const world::Scene& scene,
                                          const SimulationOptions& options,
                                          const discrepancy::RunEffects* effects,
                                          Diagnostics& diagnostics,
                                          std::vector<std::string>& notes);

/// Every plant of a scene, each of a grid by itself, with the scene's settings and what its `vary`
/// drew in it. Faults, such as a plant that is built in, go to `diagnostics`.
std::vector<PlacedPlantFile> plant_files(const world::Scene& scene,
                                         const SimulationOptions& options,
                                         Diagnostics& diagnostics);

/// Whether the settings of every scene are known keys with possible values, without building
/// anything: an impossible one is found before the first of many runs. The scenes have the same
/// plant files. Faults of the first scene that has some go to `diagnostics`.
void check_settings(const std::vector<world::Scene>& scenes, const SimulationOptions& options,
                    Diagnostics& diagnostics);

}  // namespace pedicel::simulation
