#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/stop.h"
#include "plugins/discrepancy/data/experiment.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// What the verbs that work on a measured experiment have in common on the command line.
struct ExperimentArguments {
  std::string experiment, out;
  int threads = 0;  ///< 0: all cores
  int seed = 1;
  bool json = false, quiet = false;

  int thread_count() const;
  /// `out`, or out/<prefix><name of the experiment's folder>.
  std::filesystem::path folder(const std::string& prefix,
                               const discrepancy::Experiment& measured) const;
  /// The same before the experiment is read.
  std::filesystem::path folder(const std::string& prefix) const;
  /// Whether `folder` could be written to, and none of the files is somebody else's, before what is
  /// to go there is computed. Throws io::WriteError.
  void check(const std::filesystem::path& folder, const std::vector<std::string>& files) const;
  /// io::write_folder(), and says what was replaced.
  void write(const std::filesystem::path& folder,
             const std::function<void(const std::filesystem::path&)>& write) const;
};

/// Adds the experiment itself, which is the verb's first argument.
void add_experiment(CLI::App& verb, ExperimentArguments& a);

/// Help texts of the options whose meaning depends on the verb.
struct ExperimentHelp {
  std::string out, seed, json;
};
void add_experiment_options(CLI::App& verb, ExperimentArguments& a, const ExperimentHelp& help);

/// An experiment folder, or its experiment.yaml. `scene`: the file of another scene to take in
/// place of its own. Throws InvalidFile.
discrepancy::Experiment load_experiment(const std::filesystem::path& path,
                                        const std::filesystem::path& scene = {});

/// Says on standard error what is being done, how far it is and how long it will take: on a
/// terminal in place, elsewhere a line for each new step.
class ProgressLine {
 public:
  using Callback = std::function<void(const std::string&, double)>;

  /// For options that report progress, from any thread; empty where `quiet`. It must not outlive
  /// the line.
  Callback callback(bool quiet);
  /// A sentence on a line of its own, above the progress.
  void note(const std::string& sentence);
  /// Takes the line away. `stopped`: and says that the run was.
  void end(bool stopped);

 private:
  void show(const std::string& what, double share);
  void clear();

  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  // Of the first time that anything was shown: what was done before took none of the time since.
  std::optional<double> first_share_;
  Clock::time_point start_;
  std::string last_;
};

/// Calls search(line) with the options that all searches have: threads, stop signals, and progress
/// on a line that is taken away at its end.
template <class Options, class Search>
auto with_progress(const ExperimentArguments& a, Options& options, const Search& search) {
  ProgressLine line;
  options.threads = a.thread_count();
  options.stop = &stop_requested;
  options.progress = line.callback(a.quiet);
  auto found = search(line);
  options.progress = {};  // it may not outlive the line
  line.end(found.stopped);
  return found;
}

}  // namespace pedicel::app
