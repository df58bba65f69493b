#include "app/verbs/fit.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/verbs/experiment_run.h"
#include "app/verbs/part_arguments.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/fit/parameter_fit.h"
#include "plugins/discrepancy/fit/parameter_request.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/scene_fit/scene_parameters.h"
#include "plugins/discrepancy/scene_procedure/extended_scene.h"

namespace pedicel::app {

namespace {

struct FitArguments : ExperimentArguments {
  std::vector<std::string> parameters;
  PartArguments tasks;
};

int run(FitArguments& a, const CLI::App& verb) {
  const SearchParts parts(a.tasks, a, a.folder("fit_"), verb);
  if (!a.tasks.is_task())
    a.check(a.folder("fit_"), {"fit.json", "fitted.plant.yaml", "extended.scene.yaml"});
  const discrepancy::Experiment experiment = load_experiment(a.experiment);
  const bool robot = experiment.has_robot();
  const auto starts = discrepancy::requested_starts(
      experiment,
      robot ? discrepancy::scene_vocabulary(experiment) : discrepancy::plant_vocabulary(experiment),
      a.parameters);
  discrepancy::ParameterFitOptions options;
  options.seed = static_cast<std::uint64_t>(a.seed);
  options.parts = parts.parts();
  const discrepancy::ParameterFit fit = with_progress(a, options, [&](ProgressLine&) {
    const auto ground = robot ? scene_ground(experiment, options.threads, options.stop)
                              : plant_ground(experiment, options.threads, options.stop,
                                             discrepancy::fit_noise_rule);
    return fit_parameters(*ground, starts, options);
  });
  if (fit.stopped) return stop_exit_code();
  const std::filesystem::path folder = a.folder("fit_", experiment);
  a.write(folder, [&](const std::filesystem::path& in) {
    const discrepancy::Hypothesis& model = fit.summary.hypothesis;
    if (robot)
      discrepancy::write_extended_scene(in, experiment, model.effects, 0);
    else
      plant::write_plant_file(in / "fitted.plant.yaml",
                              discrepancy::extended_plant(experiment, model));
    io::write_file_atomically(in / "fit.json", to_json(fit) + "\n");
  });
  if (a.json)
    std::cout << to_json(fit) << std::endl;
  else
    std::cout << to_table(fit) << "written to " << folder.string() << std::endl;
  return 0;
}

}  // namespace

std::function<int()> add_fit_verb(CLI::App& app) {
  const auto a = std::make_shared<FitArguments>();
  CLI::App* verb = app.add_subcommand(
      "fit", "fit parameters of a plant, or of a robot at plants, to a measured experiment");
  add_experiment(*verb, *a);
  verb->add_option("parameters", a->parameters,
                   "youngs_modulus, density, damping_time, EFFECT.PARAMETER[@CURVE:AT] (free) or "
                   "EFFECT.PARAMETER=VALUE[@CURVE:AT] (given); in a scene VALUE may name a joint, "
                   "a plant or a sensor")
      ->required();
  add_part_options(*verb, a->tasks);
  add_experiment_options(
      *verb, *a,
      {"folder for fit.json, and fitted.plant.yaml or extended.scene.yaml",
       "of the starts that are drawn", "fit.json, and nothing else, on standard output"});
  return [a, verb] { return run(*a, *verb); };
}

}  // namespace pedicel::app
