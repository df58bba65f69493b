#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/headless.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// What the command line says of a run; names as in the options.
struct RunArguments {
  std::string scene, script, out, size, unit;
  std::vector<std::string> set, packages;
  std::optional<double> duration, dt, fps, log_rate;
  std::optional<int> seed, threads;
  bool headless = false, json = false, quiet = false, no_video = false, no_pictures = false,
       no_sweep = false;
};

void add_run_options(CLI::App& app, RunArguments& a);

/// Reads the scene and applies the options to it; warnings go to standard error. Throws InvalidFile
/// and UsageError.
world::Scene load_scene(const RunArguments& a);

/// Throws UsageError for a size that is none.
RunOptions run_options(const RunArguments& a);

}  // namespace pedicel::app
