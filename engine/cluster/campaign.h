#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/cluster/cluster_options.h"
#include "engine/cluster/queue.h"
#include "engine/cluster/survey.h"
#include "engine/cluster/task_plan.h"

namespace pedicel::cluster {

/// What is done, from which share of the whole; said again and again.
using Progress = std::function<void(const std::string&, double)>;
/// A sentence for people.
using Say = std::function<void(const std::string&)>;

/// Cases that are done as tasks, from the task file to their results.
class Campaign {
 public:
  /// Writes the task file into `folder`, or finds the same cases there and goes on with them.
  /// Throws InvalidFile for an input that cannot be read, UsageError where another shell waits on
  /// this folder or where its jobs are of other cases.
  Campaign(const std::filesystem::path& folder, const Plan& plan, const ClusterOptions& options,
           const ProgramAbout& about);
  ~Campaign();

  /// Hands in what is missing, and waits for it, with progress. What was lost with a node is handed
  /// in again. Comes back when all is done, has failed or was stopped (stop_requested), or at once
  /// where the options say so. Throws std::runtime_error where the queue refuses, Stopped in the
  /// case that is measured.
  void run(const Progress& progress, const Say& say);

  const TaskFile& tasks() const { return tasks_; }
  /// As of the end of run(). Throws UsageError where the results are a mixture().
  const Survey& survey() const { return survey_; }
  /// What a case wrote; nothing where it is missing.
  std::optional<std::filesystem::path> output(int number) const;
  /// "3 of 41 cases are missing: ...", a line for each that said why; empty: none is.
  std::string missing_text() const;

 private:
  void measure_case(const Progress& progress, const Say& say);
  void submit(Queue& queue);
  bool wait(Queue& queue, const Progress& progress, const Say& say);
  void interrupted(Queue& queue, const Say& say) const;
  std::string words(const Queue::State& state) const;

  struct Lock;
  RunFolder folder_;
  ClusterOptions options_;
  std::unique_ptr<Lock> lock_;
  TaskFile tasks_;
  std::unique_ptr<Surveyor> surveyor_;
  Survey survey_;
  ProgramAbout about_;
};

/// The queue that the options name.
std::unique_ptr<Queue> make_queue(const RunFolder& folder, const TaskHead& head,
                                  const ClusterOptions& options);

}  // namespace pedicel::cluster
