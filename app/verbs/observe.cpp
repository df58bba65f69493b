#include "app/verbs/observe.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "app/bench/parallel_worlds.h"
#include "app/verbs/experiment_run.h"
#include "app/verbs/run_arguments.h"
#include "app/verbs/scene_experiment.h"
#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/core/stop.h"
#include "engine/io/output_check.h"
#include "engine/io/output_folder.h"
#include "engine/io/yaml.h"
#include "engine/world/scene_reader.h"
#include "engine/world/settings.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/simulate/simulator.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/effect_reader.h"
#include "plugins/simulation/plants/plant_overrides.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::app {

namespace {

using discrepancy::Experiment;
using discrepancy::Trial;

/// The one that is asked for; of a single one, that.
const world::ScenePlant& plant_of(const world::Scene& scene, const std::string& name) {
  std::string names;
  for (const world::ScenePlant& plant : scene.plants) {
    if (plant.name == name || (name.empty() && scene.plants.size() == 1)) return plant;
    names += (names.empty() ? "" : ", ") + plant.name;
  }
  throw UsageError("observe " + scene.file.string() + ": " +
                   (name.empty() ? "no single plant" : "no plant \"" + name + "\"") +
                   ", expected --plant with one of: " + names);
}

/// A scene's plant as the scene changes it; where it stands and what touches it is the
/// experiment's.
plant::PlantFile scene_plant(const world::ScenePlant& wanted, Diagnostics& diagnostics) {
  if (wanted.source == world::ScenePlant::Source::built_in)
    throw UsageError("observe: plant \"" + wanted.name +
                     "\" is built in, expected one that is read from a file");
  std::optional<plant::PlantFile> plant = simulation::read_scene_plant(wanted, diagnostics);
  if (!plant && !diagnostics.has_errors())
    throw UsageError("observe: plant \"" + wanted.name + "\": " + wanted.file.string() +
                     " is not there, expected a plant file or an MTG");
  if (plant) simulation::apply_plant_overrides(*plant, wanted.set, diagnostics);
  if (!plant || diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return std::move(*plant);
}

/// The plant to simulate, in the place of the one that `experiment` has.
void take_plant(const ObserveArguments& a, Experiment& experiment) {
  const std::filesystem::path model = a.model;
  Diagnostics diagnostics;
  const std::string format = format_of(model);
  if (!a.plant.empty() && format != "pedicel-scene")
    throw UsageError("--plant: " + a.model + " is no scene, expected *.scene.yaml");
  if (format == "pedicel-experiment") {
    Experiment other = load_experiment(model);
    if (other.has_robot())
      throw UsageError("observe " + a.model +
                       ": its model is a scene, expected a plant or an "
                       "experiment of one");
    experiment.plants = std::move(other.plants);
  } else if (format == "pedicel-plant") {
    auto plant = plant::read_plant_file(model, diagnostics);
    if (!plant) throw InvalidFile(diagnostics);
    experiment.plant() = std::move(*plant);
    experiment.plants.front().path = model;
  } else if (format == "pedicel-scene") {
    const std::optional<world::Scene> scene = world::read_scene(model, diagnostics);
    if (!scene) throw InvalidFile(diagnostics);
    const world::ScenePlant& wanted = plant_of(*scene, a.plant);
    experiment.plant() = scene_plant(wanted, diagnostics);
    experiment.plants.front().path = simulation::source_of(wanted);
  } else {
    throw UsageError("observe " + a.model + ": format is \"" + format +
                     "\", expected pedicel-plant, pedicel-scene or pedicel-experiment");
  }
}

plant::Effect parse_effect(const std::string& text) {
  Diagnostics diagnostics;
  const io::YamlNode node = io::parse_yaml(text, "--set", diagnostics);
  const bool named = node.is_map() && node.raw()["name"] && node.raw()["name"].IsScalar();
  const effects::EffectDefinition* known =
      named ? effects::find_effect(node.raw()["name"].Scalar()) : nullptr;
  plant::Effect effect = plant::read_effect(node, known ? known->file : effects::EffectFile::plant);
  if (diagnostics.has_errors()) throw UsageError(diagnostics.text());
  return effect;
}

// What was not measured is not observed either; where nothing was, all is still to be measured.
void keep_gaps(const discrepancy::Samples& measured, Eigen::MatrixXd& predicted) {
  if (measured.value.array().isNaN().all()) return;
  predicted = measured.value.array().isNaN().select(measured.value, predicted);
}

// Another noise than the hold's, which has the same seed: of the columns beside it.
void add_wrench_noise(const ObserveArguments& a, std::uint64_t seed, discrepancy::Samples& wrench) {
  discrepancy::Samples part = wrench;
  const auto add = [&](int first, double deviation, std::uint64_t own) {
    part.value = wrench.value.middleCols(first, 3);
    add_noise(part, deviation, a.noise_colour, own);
    wrench.value.middleCols(first, 3) = part.value;
  };
  add(0, a.noise_force, seed + 500000);
  add(3, a.noise_moment, seed + 1000000);
}

void simulate(const ObserveArguments& a, Experiment& experiment) {
  // Fruits come off by the plant's own thresholds, not when the other one's did.
  for (Trial& trial : experiment.trials) trial.events.clear();
  discrepancy::Variant variant;
  for (const std::string& text : a.set) variant.effects.push_back(parse_effect(text));
  discrepancy::Simulator simulator(experiment, {a.distance, a.dt}, a.threads);
  std::vector<discrepancy::Simulator::Request> requests;
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t)
    requests.push_back({&variant, t});
  std::vector<discrepancy::Prediction> found = simulator.run(requests);
  for (std::size_t t = 0; t < found.size(); ++t) {
    Trial& trial = experiment.trials[t];
    if (!found[t].healthy)
      throw UnstableWorld("trial \"" + trial.name + "\" cannot be simulated: lower --dt");
    keep_gaps(trial.markers, found[t].markers);
    trial.markers.value = std::move(found[t].markers);
    add_noise(trial.markers, a.noise_position, a.noise_colour, a.seed + 2 * t);
    trial.events = std::move(found[t].events);
    if (trial.wrench.size() > 0) {
      keep_gaps(trial.wrench, found[t].wrench);
      trial.wrench.value = std::move(found[t].wrench);
      add_wrench_noise(a, a.seed + 2 * t + 1, trial.wrench);
    }
    if (trial.force.size() == 0) continue;
    keep_gaps(trial.force, found[t].force);
    trial.force.value = std::move(found[t].force);
    add_noise(trial.force, a.noise_force, a.noise_colour, a.seed + 2 * t + 1);
  }
}

}  // namespace

void add_observe_options(CLI::App& observe, ObserveArguments& a) {
  finds_shipped(observe.add_option("model", a.model,
                                   "plant file, or scene or experiment whose plant is meant"))
      ->required();
  observe.add_option("--plant", a.plant, "name of the scene's plant, where it has several");
  finds_shipped(observe.add_option("--like", a.like,
                                   "experiment whose drives, markers and times are repeated"))
      ->required();
  observe.add_option("--out", a.out, "folder to write")->required();
  observe.add_option("--seed", a.seed, "of the noise");
  observe.add_option("--noise-position", a.noise_position, "standard deviation, m")
      ->check(CLI::Range(0.0, 1.0e6));
  observe.add_option("--noise-force", a.noise_force, "standard deviation, N")
      ->check(CLI::Range(0.0, 1.0e6));
  observe.add_option("--noise-moment", a.noise_moment, "standard deviation, N m")
      ->check(CLI::Range(0.0, 1.0e6));
  observe
      .add_option("--noise-colour", a.noise_colour, "correlation with the sample before (AR(1))")
      ->check(CLI::Range(0.0, 0.999));
  observe.add_option("--distance", a.distance, "between nodes, m")->check(CLI::Range(1e-4, 1.0));
  const io::Bounds dt = world::scene_bounds("dt");
  observe.add_option("--dt", a.dt, "time step, s")->check(CLI::Range(dt.minimum, dt.maximum));
  observe.add_option("--threads", a.threads)->check(CLI::Range(1, 1024));
  observe
      .add_option(
          "--set", a.set,
          "an effect as in a file, \"{name: ..., ...}\": simulated, but not written; may be "
          "repeated")
      ->allow_extra_args(false);
}

discrepancy::Experiment observed(const ObserveArguments& a, discrepancy::Experiment like) {
  take_plant(a, like);
  like.noise = {};
  if (a.noise_position > 0.0) like.noise.position_std = a.noise_position;
  if (a.noise_force > 0.0) like.noise.force_std = a.noise_force;
  if (a.noise_moment > 0.0) like.noise.moment_std = a.noise_moment;
  simulate(a, like);
  return like;
}

std::string format_of(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) return "pedicel-experiment";
  Diagnostics diagnostics;
  const io::YamlNode root = io::load_yaml(file, diagnostics);
  if (!root.is_map()) return {};
  const YAML::Node format = root.raw()["format"];
  return format.IsDefined() && format.IsScalar() ? format.Scalar() : std::string{};
}

std::filesystem::path scene_of(const std::filesystem::path& model) {
  return format_of(model) == "pedicel-experiment" ? load_experiment(model).scene.file : model;
}

int observe_verb(const ObserveArguments& a) {
  io::check_output_folder(a.out, {"experiment.yaml", "plant.yaml"});
  // The scene of `like` itself is not looked at, where it has one; a single plant has none.
  Experiment experiment = load_experiment(a.like, scene_of(a.model));
  experiment =
      experiment.has_robot() ? observed_scene(a, experiment) : observed(a, std::move(experiment));
  stop_in_good_order();
  const std::string replaced = io::write_folder(a.out, [&](const std::filesystem::path& in) {
    discrepancy::write_experiment(in, experiment);
  });
  if (!replaced.empty()) std::fprintf(stderr, "%s\n", replaced.c_str());
  std::fprintf(stderr, "written to %s\n", a.out.c_str());
  return 0;
}

void add_noise(discrepancy::Samples& samples, double deviation, double colour, std::uint64_t seed) {
  if (deviation == 0.0) return;
  const double fresh = deviation * std::sqrt(1.0 - colour * colour);
  for (int c = 0; c < samples.value.cols(); ++c) {
    Random random(Random(seed * 1000 + static_cast<std::uint64_t>(c)).next());
    double noise = deviation * random.normal();
    for (int s = 0; s < samples.size(); ++s) {
      samples.value(s, c) += noise;
      noise = colour * noise + fresh * random.normal();
    }
  }
}

}  // namespace pedicel::app
