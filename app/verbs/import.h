#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace pedicel::app {

/// What the command line says of `pedicel import`. Texts are as typed.
struct ImportArguments {
  std::vector<std::string> files;  ///< recordings, one a trial
  std::string out, plant, scene, title, format;
  std::string units, up, axes, origin, origin_pixel, camera, plane;
  std::optional<double> rate, scale, stiffness;
  double likelihood = 0.6;
  std::vector<std::string> places, names,
      holds;         ///< POINT=CURVE:AT, POINT=NAME (or the map of a log), POINT=CURVE:AT
  std::string lead;  ///< CURVE:AT
  std::vector<std::string> begins, releases, forces, force_begins;  ///< [TRIAL=]VALUE
  std::string force_column, force_unit, force_direction, force_axes, time_unit, extension;
  bool quiet = false;
};

/// Makes an experiment folder of what a laboratory's programs recorded, and checks it as `validate`
/// does. Returns the exit code: 3 where the folder was written and its data contradict themselves.
/// Throws UsageError (also for what no file states and no option says), InvalidFile,
/// io::WriteError.
int import_verb(const ImportArguments& arguments);

/// Adds the verb to the command line; the result runs it and returns the program's exit code.
std::function<int()> add_import_verb(CLI::App& app);

}  // namespace pedicel::app
