#include "engine/cluster/cluster_options.h"

#include <wordexp.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "engine/cluster/cluster_profile.h"
#include "engine/core/check.h"

namespace pedicel::cluster {

namespace {

constexpr const char* group = "Cluster";
constexpr double longest_seconds = 1.0e6;  // s
constexpr int most_jobs = 100000;

bool is_listed(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

void add_words(const CLI::Option& option, std::vector<std::string>& words) {
  if (option.get_positional()) {
    for (const std::string& value : option.results()) words.push_back(value);
  } else if (option.get_items_expected_max() == 0) {
    words.push_back(option.get_name());
  } else {
    for (const std::string& value : option.results())
      words.push_back(option.get_name() + "=" + value);
  }
}

/// $TMPDIR and the like, as a shell has them: on a node its own does that.
std::filesystem::path expanded(const std::filesystem::path& folder) {
  wordexp_t words{};
  const std::string quoted = "\"" + folder.string() + "\"";
  if (::wordexp(quoted.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF) != 0 || words.we_wordc != 1)
    throw UsageError("--scratch " + folder.string() +
                     ": expected a folder, or a variable that is set");
  std::filesystem::path path = words.we_wordv[0];
  ::wordfree(&words);
  return path;
}

template <class Wanted>
std::vector<std::string> collected(const CLI::App& verb, const Wanted& wanted) {
  std::vector<std::string> words;
  if (verb.get_parent()) words.push_back(verb.get_name());
  // Words that stand alone come last: an option before them cannot take one of them.
  for (const bool alone : {false, true})
    for (const CLI::Option* option : verb.get_options())
      if (option->count() > 0 && option->get_positional() == alone && wanted(*option))
        add_words(*option, words);
  return words;
}

}  // namespace

void add_cluster_options(CLI::App& verb, ClusterOptions& o) {
  verb.add_option("--cluster", o.mode,
                  "cases as tasks: local (processes of this machine) or slurm (a job array)")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->group(group);
  verb.add_option("--jobs", o.jobs, "tasks at a time (default: all cores; Slurm: no limit)")
      ->check(CLI::Range(1, most_jobs))
      ->group(group);
  verb.add_option("--cluster-profile", o.profile, "file with the options of a cluster")
      ->group(group);
  verb.add_option("--partition", o.partition, "of Slurm")->group(group);
  verb.add_option("--account", o.account, "of Slurm")->group(group);
  verb.add_option("--time", o.time, "that Slurm gives a task: 10:00, or minutes")->group(group);
  verb.add_option("--memory", o.memory, "that Slurm gives a task: 2G")->group(group);
  verb.add_option("--block-seconds", o.block_seconds, "s that a task is to take (default: 30)")
      ->check(CLI::Range(0.1, longest_seconds))
      ->group(group);
  verb.add_option("--case-seconds", o.case_seconds,
                  "s that a case takes (default: one is done here first, and measured)")
      ->check(CLI::Range(1.0e-3, longest_seconds))
      ->group(group);
  verb.add_option("--scratch", o.scratch, "folder of each node where results are made first")
      ->group(group);
  verb.add_option("--on-interrupt", o.on_interrupt,
                  "what Ctrl-C does to jobs of Slurm (default: leave)")
      ->check(CLI::IsMember({"leave", "cancel"}))
      ->group(group);
  verb.add_flag("--no-wait", o.no_wait, "hand everything in to Slurm, and end")->group(group);
  verb.add_flag("--collect-only", o.collect_only, "merge what is there, and do nothing else")
      ->group(group);
}

ClusterOptions with_profile(ClusterOptions o) {
  const ClusterOptions given = o;
  if (!o.profile.empty()) take_profile(read_profile(o.profile), o);
  if (!o.profile.empty() && !o.wanted())
    throw UsageError("--cluster-profile: says nothing of the mode, expected --cluster, too");
  // Of the command line: a profile may keep what one of its modes does not need.
  const std::pair<const char*, bool> needs_cluster[] = {
      {"--jobs", given.jobs > 0},
      {"--block-seconds", given.block_seconds > 0.0},
      {"--case-seconds", given.case_seconds > 0.0},
      {"--scratch", !given.scratch.empty()},
      {"--collect-only", given.collect_only}};
  const std::pair<const char*, bool> needs_slurm[] = {
      {"--partition", !given.partition.empty()},
      {"--account", !given.account.empty()},
      {"--time", !given.time.empty()},
      {"--memory", !given.memory.empty()},
      {"--on-interrupt", !given.on_interrupt.empty()},
      {"--no-wait", given.no_wait}};
  for (const auto& [option, is_given] : needs_cluster)
    if (is_given && !o.wanted())
      throw UsageError(std::string(option) + ": expected it with --cluster");
  for (const auto& [option, is_given] : needs_slurm)
    if (is_given && o.mode != "slurm")
      throw UsageError(std::string(option) + ": expected it with --cluster slurm");
  if (o.collect_only && o.no_wait)
    throw UsageError("--collect-only and --no-wait: expected one of them");
  if (o.mode == "local" && !o.scratch.empty()) o.scratch = expanded(o.scratch);
  if (o.block_seconds == 0.0) o.block_seconds = 30.0;
  if (o.on_interrupt.empty()) o.on_interrupt = "leave";
  return o;
}

std::vector<std::string> words_of(const CLI::App& verb, const std::vector<std::string>& left_out) {
  return collected(verb, [&](const CLI::Option& option) {
    return option.get_group() != group && !is_listed(left_out, option.get_name());
  });
}

std::vector<std::string> words_of_same_call(const CLI::App& verb) {
  return collected(verb, [](const CLI::Option& option) {
    return option.get_name() != "--collect-only" && option.get_name() != "--no-wait";
  });
}

}  // namespace pedicel::cluster
