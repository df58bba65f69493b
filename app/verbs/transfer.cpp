#include "app/verbs/transfer.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/verbs/experiment_run.h"
#include "app/verbs/observe.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "plugins/discrepancy/procedure/transfer.h"
#include "plugins/discrepancy/scene/run_effects.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_fit/scene_parameters.h"
#include "plugins/plant/plant_file.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::app {

namespace {

struct TransferArguments : ExperimentArguments {
  std::string extended;
};

plant::PlantFile load_plant(const std::string& path) {
  Diagnostics diagnostics;
  auto plant = plant::read_plant_file(path, diagnostics);
  if (!plant) throw InvalidFile(diagnostics);
  return *std::move(plant);
}

// Of an extended scene all effects but where a plant stands, which belongs to that place; those of
// its plants' files that the other scene's plants do not have.
std::vector<plant::Effect> scene_effects(const std::string& path,
                                         const discrepancy::Experiment& experiment) {
  Diagnostics diagnostics;
  discrepancy::Experiment other = experiment;
  if (auto scene = world::read_scene(path, diagnostics)) other.scene = std::move(*scene);
  std::vector<plant::Effect> all;
  for (plant::Effect& effect : discrepancy::scene_file_effects(other, diagnostics)) {
    const auto* known = discrepancy::find_scene_effect(effect.name);
    if (!known || !known->in_baseline) all.push_back(std::move(effect));
  }
  for (const simulation::PlacedPlantFile& plant :
       simulation::plant_files(other.scene, {}, diagnostics)) {
    const int own = experiment.plant_index(plant.file.name);
    if (own < 0) continue;
    const auto& has = experiment.plants[static_cast<std::size_t>(own)].file.effects;
    for (plant::Effect effect : discrepancy::carried_effects(plant.file.effects)) {
      if (std::ranges::find(has, effect) != has.end()) continue;
      if (experiment.plants.size() > 1) effect.words["plant"] = plant.file.name;
      all.push_back(std::move(effect));
    }
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return all;
}

std::string row(const char* trials, const discrepancy::Errors& errors) {
  if (!errors.refitted) return "";
  char text[120];
  std::snprintf(text, sizeof text, "%-10s %10.4g %10.4g %10.4g\n", trials,
                errors.nominal.value_or(0.0), *errors.refitted, errors.extended.value_or(0.0));
  return text;
}

int run(const TransferArguments& a) {
  const discrepancy::Experiment experiment = load_experiment(a.experiment);
  const bool of_scene = format_of(a.extended) == "pedicel-scene";
  if (of_scene && !experiment.has_robot())
    throw UsageError("transfer: " + a.extended + " is a scene and " + a.experiment +
                     " has no robot, expected a plant file");
  const plant::PlantFile extended = of_scene ? plant::PlantFile{} : load_plant(a.extended);
  const std::filesystem::path folder = a.folder("transfer_", experiment);
  a.check(folder, {"transfer.json"});
  discrepancy::TransferOptions options;
  const discrepancy::Transfer found = with_progress(a, options, [&](ProgressLine&) {
    if (!experiment.has_robot()) return transfer(extended, experiment, options);
    return transfer(*scene_ground(experiment, options.threads, options.stop),
                    of_scene ? scene_effects(a.extended, experiment)
                             : discrepancy::carried_effects(extended.effects),
                    options);
  });
  if (found.stopped) return stop_exit_code();
  a.write(folder, [&](const std::filesystem::path& in) {
    io::write_file_atomically(in / "transfer.json", to_json(found) + "\n");
  });
  if (a.json) {
    std::cout << to_json(found) << std::endl;
  } else {
    if (found.refusal.empty())
      std::cout << "RMS residual over the noise:\n"
                << "trials        nominal   refitted  with effects\n"
                << row("fitted", found.fit) << row("held out", found.check);
    std::cout << found.sentence() << "\nwritten to " << folder.string() << std::endl;
  }
  return found.refusal.empty() ? exit_ok : exit_code(discrepancy::Outcome::bad_data);
}

}  // namespace

std::function<int()> add_transfer_verb(CLI::App& app) {
  const auto a = std::make_shared<TransferArguments>();
  CLI::App* verb = app.add_subcommand(
      "transfer", "whether effects found in one experiment help to predict another one");
  verb->add_option("extended", a->extended,
                   "extended.plant.yaml or extended.scene.yaml of a diagnosis; its effects are "
                   "carried over")
      ->required();
  add_experiment(*verb, *a);
  add_experiment_options(*verb, *a,
                         {"folder for transfer.json", "not used: nothing is drawn",
                          "transfer.json, and nothing else, on standard output"});
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
