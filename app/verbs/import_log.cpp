#include "pedicel/app/verbs/import_log.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "pedicel/app/verbs/validate.h"
#include "pedicel/core/check.h"
#include "pedicel/core/exit_code.h"
#include "pedicel/core/stop.h"
#include "pedicel/discrepancy/log_import/log_experiment.h"
#include "pedicel/discrepancy/log_import/log_proposal.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/output_folder.h"
#include "pedicel/rosbag/reader.h"

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
                   "%s: warning: the file has no end (a run that was killed?); what was whole is "
                   "read\n",
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
    const std::string stem = log.file.stem().string();
    trial.log = log.file.filename().string();
    trial.name = stem;
    // Logs of several folders are often called the same.
    const auto is_taken = [&](const LogMap::Trial& other) { return other.name == trial.name; };
    for (int i = 2; std::ranges::any_of(trials, is_taken); ++i)
      trial.name = stem + "_" + std::to_string(i);
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

int import_with(const ImportArguments& a, const LogMap& map, const LogScene& scene,
                const std::vector<LogContents>& logs) {
  Diagnostics diagnostics;
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
  write(a, [&](const fs::path& in) { discrepancy::write_log_experiment(in, map, scene, trials); });
  std::fprintf(stderr, "written to %s\n", a.out.c_str());
  return validate_files({a.out}, {}, std::cerr);
}

int propose(const ImportArguments& a, const std::vector<LogContents>& logs) {
  if (a.scene.empty())
    throw UsageError(
        "import: a log needs the scene as it is believed to be, expected --scene with a scene "
        "file, or --map with a map that names one");
  const LogScene scene = discrepancy::read_log_scene(a.scene);
  const std::string text =
      discrepancy::proposed_map(logs.front(), scene, relative_name(a.scene, a.out));
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

bool are_logs(const ImportArguments& a) {
  const auto logs =
      static_cast<std::size_t>(std::ranges::count_if(a.files, [](const std::string& file) {
        return mcap::is_mcap(file) || rosbag::is_bag(file);
      }));
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
