#include "app/fit.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include "app/headless.h"
#include "discrepancy/diagnosis.h"
#include "discrepancy/parameter_fit.h"
#include "discrepancy/parameter_request.h"
#include "io/atomic_file.h"

namespace pedicel::app {

namespace {

struct FitArguments {
  std::string experiment, out;
  std::vector<std::string> parameters;
  int threads = 0, seed = 1;
  bool json = false, quiet = false;
};

int run(const FitArguments& a) {
  Diagnostics diagnostics;
  const auto experiment = discrepancy::read_experiment(a.experiment, diagnostics);
  if (!experiment) throw InvalidFile(diagnostics);
  const auto starts = discrepancy::requested_starts(*experiment, a.parameters);
  discrepancy::ParameterFitOptions options;
  options.threads = a.threads > 0
                        ? a.threads
                        : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.seed = static_cast<std::uint64_t>(a.seed);
  options.stop = &stop_requested;
  if (!a.quiet)
    options.progress = [](const std::string& what, double share) {
      std::fprintf(stderr, "%3.0f %% %s\n", 100.0 * share, what.c_str());
    };
  const discrepancy::ParameterFit fit = fit_parameters(*experiment, starts, options);
  if (fit.stopped) return 130;
  const std::filesystem::path folder =
      a.out.empty()
          ? std::filesystem::path("out") / ("fit_" + experiment->folder.filename().string())
          : std::filesystem::path(a.out);
  plant::write_plant_file(folder / "fitted.plant.yaml",
                          discrepancy::extended_plant(*experiment, fit.summary.hypothesis));
  io::write_file_atomically(folder / "fit.json", to_json(fit) + "\n");
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
      "fit", "fit parameters of a plant to a measured experiment, with intervals");
  verb->add_option("experiment", a->experiment, "experiment folder (or its experiment.yaml)")
      ->required();
  verb->add_option("parameters", a->parameters,
                   "youngs_modulus, density, damping_time, EFFECT.PARAMETER[@CURVE:AT] (free) or "
                   "EFFECT.PARAMETER=VALUE[@CURVE:AT] (given)")
      ->required();
  verb->add_option("--out", a->out, "folder for fit.json and fitted.plant.yaml");
  verb->add_option("--threads", a->threads, "threads (default: all cores)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--seed", a->seed, "of the starts that are drawn")
      ->check(CLI::NonNegativeNumber);
  verb->add_flag("--json", a->json, "fit.json, and nothing else, on standard output");
  verb->add_flag("--quiet", a->quiet, "no progress");
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
