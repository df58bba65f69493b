#include <algorithm>
#include <cmath>

#include "pedicel/app/session/commands/command_table.h"
#include "pedicel/app/session/commands/measured_commands.h"
#include "pedicel/app/session/document/plant_import.h"
#include "pedicel/app/session/live/organ_place.h"
#include "pedicel/app/session/session.h"
#include "pedicel/core/check.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/csv.h"

/// Commands of the run and the session.
namespace pedicel::app {

namespace {

std::string help_text(const std::string& verb) {
  std::string text;
  for (const CommandDescription& one : command_table()) {
    if (!verb.empty() && one.verb.rfind(verb, 0) != 0) continue;
    text += one.usage() + "\n    " + one.sentence + "\n";
    if (verb.empty()) continue;
    for (const ArgumentDescription& argument : one.arguments)
      text += "    " + argument.name + ": " + argument.sentence + "\n";
  }
  return text;
}

int count_curves(const Document& document) {
  int count = 0;
  for (const DocumentPlant& one : document.plants)
    if (one.file) count += static_cast<int>(one.file->curves.size());
  return count;
}

int count_fruits(const Document& document) {
  int count = 0;
  for (const DocumentPlant& one : document.plants)
    if (one.file) count += static_cast<int>(one.file->fruits.size());
  return count;
}

/// Nothing where there is no such quantity.
std::optional<double> measure(const std::string& name, const Document& document,
                              const Snapshot& now, const RunLog& log) {
  if (name == "time_s") return now.time;
  if (name == "breaks") return now.events ? static_cast<double>(now.events->size()) : 0.0;
  if (name == "plants") return static_cast<double>(document.plants.size());
  if (name == "stems") return count_curves(document);
  if (name == "fruits") return count_fruits(document);
  if (name == "pull_N") return now.pull.force_W.norm();
  if (name == "strain_1") return now.largest_strain;
  const auto series = log.series(name);
  if (series.value.empty()) return std::nullopt;
  return series.value.back();
}

int steps_of(const Command& c) {
  const int count = c.whole_or("count", 1);
  if (count < 1) throw UsageError("count " + std::to_string(count) + ", expected 1 or more");
  return count;
}

double at_least_0(const Command& c, const char* argument, const char* unit) {
  const double value = c.number(argument);
  if (value < 0.0)
    throw UsageError(std::string(argument) + " " + io::format_number(value) + ", expected " + unit +
                     " from 0 on");
  return value;
}

Result save_script(const Session& session, const std::filesystem::path& file) {
  io::write_file_atomically(file, session.script());
  return {true, std::to_string(session.log().size()) + " commands in " + file.string()};
}

}  // namespace

Result Session::session_command(const Command& c) {
  const std::string& verb = c.verb();
  if (verb == "open") {
    if (open(c.word("file"), unit_of_text(c.word_or("unit", ""), "unit"))) return {};
    return {false, messages_.back().sentence, true};
  }
  if (verb == "new") open_empty();
  if (verb == "reload" && !reload()) return {false, messages_.back().sentence, true};
  if (verb == "save script") return save_script(*this, c.word("file"));
  if (verb == "save")
    return save(c.word_or("file", ""), {c.word_or("plant", ""), c.whole_or("overwrite", 0) != 0});
  if (verb == "import")
    return import_plant(c.word("file"), c.word_or("plant", ""),
                        unit_of_text(c.word_or("unit", ""), "unit"));
  if (verb == "export") return export_plant(c.word("plant"), c.word("file"));
  if (verb == "record" || verb == "stop recording") return film_command(c);
  if (verb == "save waypoints") return save_waypoints(c.word("file"));
  if (verb == "load waypoints") return load_waypoints(c.word("file"));
  if (verb == "undo") return undo();
  if (verb == "redo") return redo();
  if (verb == "keep") return keep_parameters();
  if (verb == "discard") return discard_parameters();
  if (is_measured_command(verb)) return measured_command(c);
  if (verb == "expect") return expect_command(c);
  if (verb == "help") return {true, help_text(c.word_or("verb", ""))};
  return {};
}

Result Session::run_command(const Command& c) {
  const std::string& verb = c.verb();
  if (verb == "play") control_.play();
  if (verb == "pause") control_.pause();
  if (verb == "step") advance(steps_of(c));
  if (verb == "step back") return step_back(steps_of(c));
  if (verb == "go to") return go_to(at_least_0(c, "time", "s"));
  if (verb == "run") run_for(at_least_0(c, "duration", "s"));
  if (verb == "reset") control_.reset();
  if (verb == "speed") control_.set_speed(at_least_0(c, "value", "simulated s a wall s"));
  if (verb == "pull") return pull_command(c);
  if (verb == "release") control_.end_pull();
  if (verb == "watch") control_.log().watch(c.word("organ"));
  return robot_command(c);
}

Result Session::step_back(long steps) {
  const long now = snapshot()->step;
  if (steps > now)
    return {false, "step back: " + std::to_string(steps) + " from step " + std::to_string(now) +
                       (now == 0 ? ", expected a run that has begun"
                                 : ", expected at most as many as were done")};
  control_.step_back(steps);
  return {};
}

Result Session::go_to(double time) {
  const auto now = snapshot();
  if (!now->assets) return {false, "go to: nothing is simulated yet"};
  control_.go_to_step(std::lround(time / now->assets->scene.dt));
  return {};
}

Result Session::pull_command(const Command& c) {
  const auto now = snapshot();
  const std::optional<PullPlace> found = find_organ(*now, c.word("organ"), c.number_or("at", 1.0));
  if (!found)
    return {false, "pull: no organ \"" + c.word("organ") +
                       "\" in the simulation, expected one of: " + organ_names(*now)};
  PullPlace place = *found;
  place.stiffness = c.number_or("stiffness", place.stiffness);
  if (!(place.stiffness > 0.0)) return {false, "pull: stiffness, expected N/m above 0"};
  note_pull(true);
  control_.begin_pull(place, c.point("to"));
  return {};
}

Result Session::expect_command(const Command& c) const {
  const std::string& name = c.word("quantity");
  const auto value = measure(name, document_, *snapshot(), control_.log());
  if (!value)
    return {false, "expect: no quantity \"" + name +
                       "\", expected time_s, breaks, plants, stems, fruits, pull_N, strain_1 or a "
                       "column of log.csv"};
  const bool met = (!c.has("above") || *value > c.number("above")) &&
                   (!c.has("below") || *value < c.number("below")) &&
                   (!c.has("is") || *value == c.number("is"));
  const std::string text = name + " is " + io::format_number(*value);
  return {met, met ? text : text + ", not as expected: " + c.text()};
}

}  // namespace pedicel::app
