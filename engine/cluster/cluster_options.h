#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace pedicel::cluster {

/// What the command line, or a profile file, says of where and how cases are done.
struct ClusterOptions {
  std::string mode;  ///< "local", "slurm"; empty: in this program, as ever
  std::filesystem::path profile;
  std::string partition, account, time, memory;  ///< as sbatch takes them; empty: its defaults
  int jobs = 0;                     ///< tasks at a time; 0: all cores of this machine, or no limit
  double block_seconds = 0.0;       ///< s, that a task is to take; 0: 30
  double case_seconds = 0.0;        ///< s, of one case; 0: one is measured first
  std::filesystem::path scratch;    ///< folder on a node's own disk
  std::string on_interrupt;         ///< "leave", "cancel"; empty: leave
  std::vector<std::string> sbatch;  ///< further options of sbatch, from the profile
  std::vector<std::string> before;  ///< lines of shell before the program, from the profile
  bool collect_only = false;        ///< merges what is there, and hands nothing in
  bool no_wait = false;             ///< hands everything in, and ends

  bool wanted() const { return !mode.empty(); }
};

/// Adds --cluster and what belongs to it, as one group of the help.
void add_cluster_options(CLI::App& verb, ClusterOptions& options);

/// With what the profile says, where the command line says nothing. Throws InvalidFile for a
/// profile with faults, UsageError for options that make no sense without --cluster.
ClusterOptions with_profile(ClusterOptions given);

/// The words of a command line that was parsed: the verb's name, its options as --name=value, its
/// other words. Without the group of --cluster, and without `left_out` ("--out").
std::vector<std::string> words_of(const CLI::App& verb, const std::vector<std::string>& left_out);
/// With that group, for the same call once more; without --collect-only and --no-wait.
std::vector<std::string> words_of_same_call(const CLI::App& verb);

}  // namespace pedicel::cluster
