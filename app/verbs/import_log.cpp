#include "app/verbs/import_log.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "app/verbs/validate.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "engine/io/output_folder.h"
#include "engine/io/unit_text.h"
#include "engine/mcap/reader.h"
#include "engine/rosbag/reader.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/log_import/log_experiment.h"
#include "plugins/discrepancy/log_import/log_proposal.h"

namespace pedicel::app {

namespace {

namespace fs = std::filesystem;
using discrepancy::LogContents;
using discrepancy::LogMap;
using discrepancy::LogScene;

/// What a proposal cannot know, and the person has to say.
constexpr const char* open_question = "topic: ?";

std::vector<LogContents> read_logs(const ImportArguments& a) {
  std::vector<LogContents> logs;
  for (const std::string& file : a.files) {
    logs.push_back(discrepancy::read_log(file));
    if (!logs.back().whole)
      std::fprintf(stderr,
                   "%s: warning: the file is cut off (a run that was killed, a copy that ended too "
                   "soon?); what is whole before that is read\n",
                   printable(file).c_str());
  }
  return logs;
}

/// A trial a log, named by the file, where the map names none.
std::vector<LogMap::Trial> trials_of(const LogMap& map, const std::vector<LogContents>& logs) {
  if (!map.trials.empty()) return map.trials;
  std::vector<LogMap::Trial> trials;
  for (const LogContents& log : logs) {
    LogMap::Trial trial;
    trial.log = log.file.filename().string();
    trial.name = log.file.stem().string();
    if (std::ranges::find(trials, trial.name, &LogMap::Trial::name) != trials.end())
      throw UsageError("import: two logs give the trial " + in_quotes(trial.name) +
                       ", expected logs of different names, or --map with trials");
    trials.push_back(trial);
  }
  return trials;
}

const LogContents& log_of(const LogMap::Trial& trial, const std::vector<LogContents>& logs,
                          Diagnostics& diagnostics) {
  const auto is_it = [&](const LogContents& log) { return log.file.filename() == trial.log; };
  const auto found = std::ranges::find_if(logs, is_it);
  if (std::ranges::count_if(logs, is_it) > 1)
    diagnostics.error(trial.where, "log " + in_quotes(trial.log) +
                                       " is the name of several of the files given, expected one");
  if (found != logs.end()) return *found;
  if (!trial.log.empty() || logs.size() > 1)
    diagnostics.error(trial.where, "log " + in_quotes(trial.log) +
                                       " is none of the files given, expected the name of one");
  return logs.front();
}

std::string relative_name(const fs::path& file, const fs::path& folder) {
  const fs::path to = fs::weakly_canonical(fs::absolute(folder));
  const fs::path name = fs::weakly_canonical(file).lexically_relative(to);
  return name.empty() ? fs::weakly_canonical(file).string() : name.string();
}

void write(const ImportArguments& a, const std::function<void(const fs::path&)>& files) {
  stop_in_good_order();
  const std::string replaced = io::write_folder(a.out, files);
  if (!replaced.empty()) std::fprintf(stderr, "%s\n", replaced.c_str());
}

/// What was written must be an experiment; else nothing is. Faults name the place that it was
/// meant for.
void check_written(const fs::path& in, const fs::path& out) {
  Diagnostics found, told;
  if (discrepancy::read_experiment(in, found) && !found.has_errors()) return;
  for (Diagnostic one : found.all()) {
    const fs::path inside = fs::path(one.where.file).lexically_relative(in);
    if (!inside.empty() && *inside.begin() != "..") one.where.file = (out / inside).string();
    if (one.severity == Severity::error) told.error(one.where, one.what + " (it is not written)");
  }
  throw InvalidFile(told);
}

int import_with(const ImportArguments& a, const LogMap& map, const LogScene& scene,
                const std::vector<LogContents>& logs) {
  Diagnostics diagnostics;
  discrepancy::check_places(map, scene, diagnostics);
  std::vector<discrepancy::LogTrial> trials;
  const std::vector<LogMap::Trial> wanted = trials_of(map, logs);
  for (std::size_t t = 0; t < wanted.size(); ++t) {
    const LogMap::Trial& trial = wanted[t];
    const LogContents& log = map.trials.empty() ? logs[t] : log_of(trial, logs, diagnostics);
    trials.push_back(discrepancy::trial_of_log(log, map, trial, scene, diagnostics));
    for (const std::string& remark : trials.back().remarks)
      if (!a.quiet) std::fprintf(stderr, "%s\n", printable(remark).c_str());
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  write(a, [&](const fs::path& in) {
    discrepancy::write_log_experiment(in, map, scene, trials);
    check_written(in, a.out);
  });
  std::fprintf(stderr, "written to %s\n", a.out.c_str());
  return validate_files({a.out}, {}, std::cerr);
}

/// A map that a person has changed is no proposal any more, also where a run of ours wrote it.
void check_no_answers_are_lost(const ImportArguments& a, const std::string& proposed) {
  const fs::path map = fs::path(a.out) / "map.yaml";
  std::error_code none;
  if (fs::exists(map, none) && io::read_file(map) != proposed)
    throw io::WriteError(map.string() +
                         ": is not as it is proposed from these logs (it was changed?), expected "
                         "--map with it, or another folder (--out)");
}

int propose(const ImportArguments& a, const std::vector<LogContents>& logs) {
  if (a.scene.empty())
    throw UsageError(
        "import: a log needs its nominal scene, expected --scene with a scene "
        "file, or --map with a map that names one");
  const LogScene scene = discrepancy::read_log_scene(a.scene);
  const std::string text =
      discrepancy::proposed_map(logs.front(), scene, relative_name(a.scene, a.out));
  check_no_answers_are_lost(a, text);
  if (text.find(open_question) != std::string::npos) {
    write(a, [&](const fs::path& in) { io::write_file_atomically(in / "map.yaml", text); });
    std::fprintf(stderr,
                 "written to %s/map.yaml: a first map; where it says ? it needs an answer, then "
                 "import with --map\n",
                 a.out.c_str());
    return exit_invalid;
  }
  Diagnostics diagnostics;
  const auto map = discrepancy::parse_log_map(text, fs::path(a.out) / "map.yaml", diagnostics);
  if (!map) throw InvalidFile(diagnostics);
  if (!a.quiet)
    std::fprintf(stderr, "a first map is proposed: %s/map.yaml; change it, and import with --map\n",
                 a.out.c_str());
  return import_with(a, *map, scene, logs);
}

}  // namespace

namespace {

/// By what it begins with, else by its name: then the reader says what is wrong with it.
bool is_log(const std::string& file) {
  const std::string ending = fs::path(file).extension().string();
  return mcap::is_mcap(file) || rosbag::is_bag(file) || io::same_but_case(ending, ".mcap") ||
         io::same_but_case(ending, ".bag");
}

}  // namespace

bool are_logs(const ImportArguments& a) {
  const auto logs = static_cast<std::size_t>(std::ranges::count_if(a.files, is_log));
  if (logs > 0 && logs < a.files.size())
    throw UsageError(
        "import: some files are logs (MCAP, bags) and some are not, expected one kind");
  return logs > 0;
}

int import_log_verb(const ImportArguments& a) {
  if (!a.plant.empty())
    throw UsageError("--plant: a log of a robot belongs to a scene, expected --scene");
  if (!a.title.empty()) throw UsageError("--title: expected title: in the map of a log");
  const std::vector<LogContents> logs = read_logs(a);
  if (a.names.empty()) return propose(a, logs);
  if (a.names.size() > 1) throw UsageError("--map: expected one file for a log");
  Diagnostics diagnostics;
  const auto map = discrepancy::read_log_map(a.names.front(), diagnostics);
  if (!map) throw InvalidFile(diagnostics);
  const fs::path scene = a.scene.empty() ? map->file.parent_path() / map->scene : fs::path(a.scene);
  return import_with(a, *map, discrepancy::read_log_scene(scene), logs);
}

}  // namespace pedicel::app
