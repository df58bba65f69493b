#include "app/verbs/save_plants.h"

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_writer.h"
#include "engine/world/settings.h"
#include "plugins/plant/plant_file.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::app {

namespace {

void expect_new(const std::filesystem::path& path) {
  if (std::filesystem::exists(path))
    throw UsageError("--save-plants: " + path.string() + " is there already, expected a new name");
}

// Leaf templates that lie beside a plant come along; shipped ones are found from everywhere.
void take_templates(const simulation::PlacedPlantFile& plant, const std::filesystem::path& folder) {
  for (const plant::PlantLeaf& leaf : plant.file.leaves) {
    const std::filesystem::path name = leaf.leaf_template + ".leaf.yaml";
    const std::filesystem::path to = folder / name;
    if (std::filesystem::exists(plant.source.parent_path() / name) && !std::filesystem::exists(to))
      io::write_file_atomically(to, io::read_file(plant.source.parent_path() / name));
  }
}

}  // namespace

std::string save_plants(const world::Scene& scene, const simulation::SimulationOptions& options,
                        const std::filesystem::path& folder) {
  // They name an entry, and here each of its plants becomes an entry.
  if (!scene.effects.empty())
    throw UsageError("--save-plants: the scene has effects, expected a scene without");
  const world::Scene drawn = scene.vary.empty() ? scene : world::drawn_scene(scene);
  Diagnostics diagnostics;
  const std::vector<simulation::PlacedPlantFile> plants =
      simulation::plant_files(drawn, options, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);

  // After the scene's file, since a scene's own name may hold any character.
  const std::string name = scene.file.filename().string();
  const std::filesystem::path scene_file =
      folder / (name.ends_with(".scene.yaml") ? name : "plants.scene.yaml");
  world::Scene apart = drawn;
  apart.plants.clear();
  for (const simulation::PlacedPlantFile& one : plants) {
    world::ScenePlant& entry = apart.plants.emplace_back();
    entry.name = one.file.name;
    entry.file = folder / (one.file.name + ".plant.yaml");
    entry.pose = one.pose;
    // Nothing is written where one of them is in the way.
    expect_new(entry.file);
  }
  expect_new(scene_file);
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    take_templates(plants[i], folder);
    plant::write_plant_file(apart.plants[i].file, plants[i].file);
  }
  // Last, so that a scene that is there has all its plants.
  io::write_file_atomically(scene_file, world::scene_text(apart, folder));
  return std::to_string(plants.size()) + " plants and " + scene_file.string() + " written";
}

}  // namespace pedicel::app
