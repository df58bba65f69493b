#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/report/headless.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace pedicel::app {

/// What the command line says of a run; names as in the options.
struct RunArguments {
  const CLI::App* app = nullptr;  ///< that has read them
  std::string scene, script, out, size, camera, unit;
  std::string log, events, gltf, trajectory, compare, save_state, load_state, save_plants,
      param_sweep;
  std::vector<std::string> set, packages;
  /// duration, dt, log_rate, seed, threads as they were typed: the same run as by `--set`.
  std::vector<std::pair<std::string, std::string>> numbers;
  std::optional<double> fps, tolerance;
  std::optional<long> steps;
  std::optional<int> verbosity;
  bool json = false, quiet = false, no_video = false, no_pictures = false, no_sweep = false,
       print_scene = false;

  /// Of `numbers`; empty where it was not given.
  std::string number(const std::string& key) const;
  /// Whether one of these options stands in the command line.
  bool has_one_of(std::initializer_list<const char*> options) const;
  /// Throws UsageError where one of them does: "--log: " and why.
  void refuse(std::initializer_list<const char*> options, const std::string& why) const;
  /// Whether there is something that only a run off screen does.
  bool asks_for_run() const;
};

void add_run_options(CLI::App& app, RunArguments& a);

/// An option that names files to read: those that ship with the program are found by their names
/// (io::shipped_file), wherever it runs.
CLI::Option* finds_shipped(CLI::Option* option);

/// Refuses options that exclude each other, and applies those that count for the whole program.
/// Throws UsageError.
void check_run_arguments(const RunArguments& a);

/// Reads the scene and applies the options to it; warnings go to standard error. Throws InvalidFile
/// and UsageError.
world::Scene load_scene(const RunArguments& a);

/// Throws UsageError where the scene has no camera of the name that --camera gives.
void check_camera(const world::Scene& scene, const std::string& name);

/// Throws UsageError for a size that is none, and InvalidFile for measured data that are none.
RunOptions run_options(const RunArguments& a);
/// With the plant, where that is all there is. Every place that is written to is looked at before
/// anything is touched: throws io::WriteError, and UsageError where an output is an input.
RunOptions options_of_run(const RunArguments& a);

/// How much the program says from now on: --quiet, -v.
void apply_verbosity(const RunArguments& a);

/// Says where everything was written, and the result as JSON where that was asked for. Returns the
/// exit code.
int end_of_run(const world::Scene& scene, const RunArguments& a, const RunOptions& options,
               const SceneResult& result);

}  // namespace pedicel::app
