#include "app/verbs/transfer.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/verbs/experiment_run.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/procedure/transfer.h"
#include "plugins/plant/plant_file.h"

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

std::string row(const char* trials, const discrepancy::Errors& errors) {
  if (!errors.refitted) return "";
  char text[120];
  std::snprintf(text, sizeof text, "%-10s %10.4g %10.4g %10.4g\n", trials,
                errors.nominal.value_or(0.0), *errors.refitted, errors.extended.value_or(0.0));
  return text;
}

int run(const TransferArguments& a) {
  const plant::PlantFile extended = load_plant(a.extended);
  const discrepancy::Experiment experiment = load_plant_experiment(a);
  const std::filesystem::path folder = a.folder("transfer_", experiment);
  a.check(folder, {"transfer.json"});
  discrepancy::TransferOptions options;
  const discrepancy::Transfer found = with_progress(
      a, options, [&](ProgressLine&) { return transfer(extended, experiment, options); });
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
      "transfer", "whether effects found in one experiment help to foretell another one");
  verb->add_option("extended", a->extended,
                   "extended.plant.yaml of a diagnosis; its effects are carried over")
      ->required();
  add_experiment(*verb, *a);
  add_experiment_options(*verb, *a,
                         {"folder for transfer.json", "not used: nothing is drawn",
                          "transfer.json, and nothing else, on standard output"});
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
