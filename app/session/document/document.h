#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/world/scene.h"
#include "plugins/plant/plant_file.h"
#include "plugins/simulation/simulation_options.h"

namespace pedicel::app {

/// A plant of the document: where it stands in the scene, and what its file says now.
struct DocumentPlant {
  world::ScenePlant entry;
  /// Null for what cannot be edited (built-in plants). Shared between the document's past states.
  std::shared_ptr<const plant::PlantFile> file;
};

/// Where the robot is to be at a time after the program's start.
using RobotWaypoint = world::RecordedPose;

/// Everything that a user edits, as a value: copies are cheap (plants are shared until one is
/// changed), so a document's past states are kept whole for undo.
struct Document {
  /// Robot, bodies, ground, cameras and the rest; its plants are as they were read, those of now
  /// are in `plants`. Made up where a lone plant, or nothing, was opened.
  std::shared_ptr<const world::Scene> scene;
  std::filesystem::path path;  ///< the scene's or the lone plant's; empty: new
  double unit = 0.0;           ///< m, of the lone plant's file; 0: as that says
  std::vector<DocumentPlant> plants;
  /// Over what the scene says, as in `--set`: key and text.
  std::vector<std::pair<std::string, std::string>> settings;
  std::vector<RobotWaypoint> waypoints;  ///< a scene keeps them as `robot: recorded:`

  /// -1 where there is none of that name.
  int plant_index(const std::string& name) const;
  /// Throws UsageError for a plant that is not there or cannot be edited.
  const plant::PlantFile& plant(const std::string& name) const;
  /// The same, to change it: a copy of its own.
  plant::PlantFile& edit_plant(const std::string& name);

  /// The scene, to change it: a copy of its own. The plants of now are in `plants`.
  world::Scene& edit_scene();

  /// Of everything that commands change, bit by bit; not of paths.
  std::uint64_t state_hash() const;
};

/// By its name: *.scene.yaml.
bool is_scene(const std::filesystem::path& path);

/// By its name: *.plant.yaml, *.csv, *.tsv, *.txt, *.ply (a skeleton), *.mtg or *.xml (of Helios).
bool is_lone_plant(const std::filesystem::path& path);

/// Lowers the ground of a document without a scene file under plants that lie in it.
void stand_on_ground(Document& document);

/// An empty document: ground, gravity, nothing on it.
Document empty_document();
/// A scene that was read, with the files of its plants; it has no path. Faults go to `diagnostics`.
Document document_of(world::Scene scene, Diagnostics& diagnostics);
/// Reads a scene (*.scene.yaml), a plant file, a skeleton table (*.csv) or an MTG (*.mtg) with
/// everything that it names. `unit` (m) is that of the lengths in a lone table or MTG; 0: as the
/// file says. Throws InvalidFile with every fault found; warnings and heights go to `remarks`.
Document open_document(const std::filesystem::path& path, double unit = 0.0,
                       Diagnostics* remarks = nullptr);

/// The scene with the document's plants and settings in it, and the plants that take the place of
/// files. Throws UsageError for a setting that is impossible.
world::Scene scene_of(const Document& document);
simulation::SimulationOptions options_of(const Document& document,
                                         const std::vector<std::string>& packages);

/// Where leaf templates are looked for after a plant's own folders: the shipped ones; empty without
/// assets.
std::vector<std::filesystem::path> asset_leaf_folders();

}  // namespace pedicel::app
