#include "plugins/simulation/scene_plants.h"

#include <map>

#include "engine/io/csv.h"
#include "engine/world/settings.h"
#include "plugins/cosserat/solver/standing.h"
#include "plugins/discrepancy/scene/state_changes.h"
#include "plugins/plant/plant_builder.h"
#include "plugins/plant/reference_plants.h"
#include "plugins/simulation/large_plant.h"
#include "plugins/simulation/plants/plant_overrides.h"
#include "plugins/simulation/plants/rod_options.h"
#include "plugins/simulation/plants/varied_plant.h"
#include "plugins/skeleton/plant_source.h"

namespace pedicel::simulation {

namespace {

using world::ScenePlant;

/// Rod elements of a scene, some 1.5 kB each in the solver.
constexpr double most_elements = 500'000;
constexpr std::size_t most_files = 10'000;  // plants that are written one by one

std::optional<plant::PlantFile> read_file(const ScenePlant& wanted, Diagnostics& diagnostics,
                                          std::vector<std::string>& notes) {
  if (source_of(wanted) != wanted.file)
    notes.push_back(wanted.name + ": " + wanted.file.string() + " is not there" +
                    (wanted.fallback.empty() ? "; the scene runs without it"
                                             : "; taken instead: " + wanted.fallback.string()));
  return read_scene_plant(wanted, diagnostics);
}

ScenePlantModel reference_plant(const ScenePlant& wanted, int index, Diagnostics& diagnostics) {
  ScenePlantModel made;
  if (wanted.built_in == "forest")
    made.model = plant::forest_plant(index);
  else if (wanted.built_in == "hanging_tree")
    made.model = plant::hanging_tree();
  else if (wanted.built_in == "cantilever")
    made.model = plant::cantilever(20);
  else
    diagnostics.error(wanted.where, "built_in is \"" + wanted.built_in +
                                        "\", expected one of: forest, hanging_tree, cantilever");
  return made;
}

/// The plants of one entry: names, places and overrides.
class Builder {
 public:
  Builder(const world::Scene& scene, const SimulationOptions& options,
          const discrepancy::RunEffects* effects, Diagnostics& diagnostics,
          std::vector<std::string>& notes)
      : scene_(scene),
        options_(options),
        effects_(effects),
        diagnostics_(diagnostics),
        notes_(notes) {}

  void add(const ScenePlant& wanted) {
    if (wanted.source == ScenePlant::Source::built_in) return add_reference(wanted);
    const std::optional<plant::PlantFile> file = file_of(wanted);
    if (!file) return;
    say_if_large(*file);
    const int count = wanted.repeat[0] * wanted.repeat[1];
    for (int i = 0; i < count && !diagnostics_.has_errors(); ++i) {
      // The first one tells how large they are; a thousand more may not fit into memory.
      if (i == 1 && !is_affordable(wanted, count)) return;
      const PlacedPlantFile one = of_grid(*file, wanted, i);
      add_file(one.file, wanted, one.pose);
    }
  }

  /// The same plants as files, without what the scene's effects change.
  void add_files(const ScenePlant& wanted, std::vector<PlacedPlantFile>& files) {
    const std::size_t count =
        files.size() + static_cast<std::size_t>(wanted.repeat[0]) * wanted.repeat[1];
    // Before one of them is made: a grid may ask for 10,000 times 10,000.
    if (count > most_files) {
      diagnostics_.error(wanted.where, "plant \"" + wanted.name + "\": makes " +
                                           std::to_string(count) +
                                           " files with those before it, expected at most " +
                                           std::to_string(most_files));
      return;
    }
    const std::optional<plant::PlantFile> file = file_of(wanted);
    for (int i = 0; file && i < wanted.repeat[0] * wanted.repeat[1]; ++i) {
      files.push_back(of_grid(*file, wanted, i));
      files.back().source = source_of(wanted);
    }
  }

  std::vector<ScenePlantModel> plants;

 private:
  // As an entry of the scene has it, with the entry's settings; nothing where it is faulty.
  std::optional<plant::PlantFile> file_of(const ScenePlant& wanted) {
    const auto edited = options_.edited.find(wanted.name);
    // A plant that is edited goes before its file, also where that is faulty by now.
    const bool is_edited = edited != options_.edited.end();
    std::optional<plant::PlantFile> file =
        is_edited ? std::optional(edited->second) : read_file(wanted, diagnostics_, notes_);
    // One that was emptied by hand is no fault: nothing is drawn yet.
    if (!file || (is_edited && file->curves.empty())) return std::nullopt;
    apply_plant_overrides(*file, wanted.set, diagnostics_);
    add_effects(*file, wanted);
    if (diagnostics_.has_errors()) return std::nullopt;
    return file;
  }

  PlacedPlantFile of_grid(const plant::PlantFile& file, const ScenePlant& wanted, int i) {
    PlacedPlantFile one{file, wanted.pose, {}};
    one.pose.position.x() += wanted.spacing.x() * (i % wanted.repeat[0]);
    one.pose.position.y() += wanted.spacing.y() * (i / wanted.repeat[0]);
    // Names in logs and expectations must tell the copies apart.
    const bool is_grid = wanted.repeat[0] * wanted.repeat[1] > 1;
    one.file.name = is_grid ? wanted.name + "_" + std::to_string(i) : wanted.name;
    if (!wanted.vary.empty())
      vary_plant(wanted, i, static_cast<std::uint64_t>(scene_.seed), one.file, one.pose,
                 diagnostics_);
    return one;
  }

  // Once the first of `count` equal plants is built. Before the others are.
  bool is_affordable(const ScenePlant& wanted, int count) {
    const double elements = static_cast<double>(count) * plants.back().model.size();
    if (elements <= most_elements) return true;
    diagnostics_.error(wanted.where,
                       "plant \"" + wanted.name + "\": repeat makes " + std::to_string(count) +
                           " plants of " + std::to_string(plants.back().model.size()) +
                           " rod elements, " + io::format_number(elements, 3) +
                           " in all: expected at most " + io::format_number(most_elements));
    return false;
  }

  void add_effects(plant::PlantFile& file, const ScenePlant& wanted) {
    if (!effects_) return;
    for (plant::Effect& effect : effects_->of_plant(wanted.name)) {
      if (effect.place && file.curve_index(effect.place->curve) < 0) {
        std::string names;
        for (const plant::PlantCurve& curve : file.curves)
          names += (names.empty() ? "" : ", ") + curve.name;
        diagnostics_.error(effect.where, "effect " + effect.name + " is on curve " +
                                             in_quotes(effect.place->curve) + ", which plant " +
                                             in_quotes(wanted.name) +
                                             " does not have: expected one of: " + names);
        continue;
      }
      file.effects.push_back(std::move(effect));
    }
  }

  // What effects change of one entry of the scene; null: nothing.
  const discrepancy::SceneState::Plant* changes_of(const ScenePlant& wanted) const {
    const auto p = static_cast<std::size_t>(&wanted - scene_.plants.data());
    return effects_ ? &effects_->state.plants[p] : nullptr;
  }

  plant::BuildOptions options_for(const ScenePlant& wanted, const Pose& pose) const {
    const auto beside = wanted.file.parent_path();
    plant::BuildOptions options{
        pose,
        scene_.gravity,
        {beside, beside / "../assets/leaves", scene_.file.parent_path() / "../leaves"}};
    options.leaf_folders.insert(options.leaf_folders.end(), options_.leaf_folders.begin(),
                                options_.leaf_folders.end());
    return options;
  }

  void add_file(const plant::PlantFile& file, const ScenePlant& wanted, Pose pose) {
    const discrepancy::SceneState::Plant* changes = changes_of(wanted);
    if (changes && !(changes->offset.isZero(0.0) && changes->yaw == 0.0)) {
      const Pose by = discrepancy::moved_plant(pose * file.root, *changes);
      pose = {by * pose.position, (by.rotation * pose.rotation).normalized()};
    }
    std::optional<plant::BuiltPlant> built =
        plant::build_plant(file, options_for(wanted, pose), diagnostics_);
    if (!built) return;
    ScenePlantModel made;
    made.info.name = file.name;
    made.info.look = file.look;
    made.info.sampled_nodes = built->nodes_sampled;
    made.info.residual = built->residual;
    made.info.residual_text = plant::residual_text(*built);
    for (const auto& triangle : built->blades) {
      Blade blade;
      for (int c = 0; c < 3; ++c)
        blade[c] = {triangle.corners[c].element, triangle.corners[c].back};
      made.info.blades.push_back(blade);
    }
    made.model = std::move(built->model);
    if (changes) discrepancy::change_plant(made.model, *changes);
    plants.push_back(std::move(made));
  }

  void add_reference(const ScenePlant& wanted) {
    if (!wanted.set.empty())
      diagnostics_.error(wanted.set.front().where,
                         "set: a built-in plant cannot be changed, expected none");
    if (!wanted.vary.empty())
      diagnostics_.error(wanted.vary.front().where,
                         "vary: a built-in plant cannot be changed, expected none");
    const int count = wanted.built_in == "forest" ? plant::forest_size : 1;
    for (int i = 0; i < count && !diagnostics_.has_errors(); ++i) {
      ScenePlantModel made = reference_plant(wanted, i, diagnostics_);
      if (count > 1) made.model.name = wanted.name + "_" + std::to_string(i);
      made.info.name = made.model.name;
      plants.push_back(std::move(made));
    }
  }

  const world::Scene& scene_;
  const SimulationOptions& options_;
  const discrepancy::RunEffects* effects_;
  Diagnostics& diagnostics_;
  std::vector<std::string>& notes_;
};

}  // namespace

std::filesystem::path source_of(const ScenePlant& plant) {
  return plant.optional && !std::filesystem::exists(plant.file) ? plant.fallback : plant.file;
}

std::optional<plant::PlantFile> read_scene_plant(const ScenePlant& plant,
                                                 Diagnostics& diagnostics) {
  const std::filesystem::path source = source_of(plant);
  // An optional file that is absent has no kind to look for.
  if (source.empty()) return std::nullopt;
  // The fallback of an MTG is a plant file, and so is what has no name that tells.
  const bool own = source == plant.file;
  plant::SourceKind kind = plant::source_kind(source);
  if (kind == plant::SourceKind::unknown) kind = plant::SourceKind::plant_file;
  if (own && plant.source == ScenePlant::Source::mtg) kind = plant::SourceKind::mtg;
  return plant::read_plant_source(source, own ? plant.unit : 0.0, diagnostics, kind);
}

std::vector<ScenePlantModel> build_plants(const world::Scene& scene,
                                          const SimulationOptions& options,
                                          const discrepancy::RunEffects* effects,
                                          Diagnostics& diagnostics,
                                          std::vector<std::string>& notes) {
  Builder builder(scene, options, effects, diagnostics, notes);
  for (const ScenePlant& wanted : scene.plants) builder.add(wanted);
  return std::move(builder.plants);
}

std::vector<PlacedPlantFile> plant_files(const world::Scene& scene,
                                         const SimulationOptions& options,
                                         Diagnostics& diagnostics) {
  std::vector<std::string> notes;
  Builder builder(scene, options, nullptr, diagnostics, notes);
  std::vector<PlacedPlantFile> files;
  for (const ScenePlant& wanted : scene.plants) {
    if (wanted.source == ScenePlant::Source::built_in)
      diagnostics.error(wanted.where,
                        "plant \"" + wanted.name + "\" is built in, expected one that has a file");
    else
      builder.add_files(wanted, files);
  }
  return files;
}

namespace {

/// Plants as their files have them, each read once.
class PlantFiles {
 public:
  explicit PlantFiles(const SimulationOptions& options) : options_(options) {}

  const std::optional<plant::PlantFile>& of(const ScenePlant& wanted, Diagnostics& diagnostics) {
    const auto known = files_.find(wanted.name);
    if (known != files_.end()) return known->second;
    const auto edited = options_.edited.find(wanted.name);
    return files_[wanted.name] = edited != options_.edited.end()
                                     ? std::optional(edited->second)
                                     : read_scene_plant(wanted, diagnostics);
  }

 private:
  const SimulationOptions& options_;
  std::map<std::string, std::optional<plant::PlantFile>> files_;
};

}  // namespace

void check_settings(const std::vector<world::Scene>& scenes, const SimulationOptions& options,
                    Diagnostics& diagnostics) {
  PlantFiles files(options);
  for (const world::Scene& given : scenes) {
    const world::Scene scene = given.vary.empty() ? given : world::drawn_scene(given);
    cosserat::RodSettings rods;
    coupling::CouplingSettings coupling;
    apply_rod_settings(scene.rods, rods, diagnostics);
    apply_coupling_settings(scene.coupling, coupling, diagnostics);
    for (const ScenePlant& wanted : scene.plants) {
      if (wanted.source == ScenePlant::Source::built_in) continue;
      if (wanted.set.empty() && wanted.vary.empty()) continue;
      std::optional<plant::PlantFile> file = files.of(wanted, diagnostics);
      if (!file) continue;
      apply_plant_overrides(*file, wanted.set, diagnostics);
      // Of a grid the first plant: an unknown key is unknown to all of them.
      Pose pose;
      if (!wanted.vary.empty())
        vary_plant(wanted, 0, static_cast<std::uint64_t>(scene.seed), *file, pose, diagnostics);
    }
    if (diagnostics.has_errors()) return;
  }
}

}  // namespace pedicel::simulation
