#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/cluster/task_file.h"

namespace pedicel::cluster {

/// Where the parts of a run lie, below its own folder.
class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path tasks() const { return folder_ / "tasks.jsonl"; }
  std::filesystem::path jobs() const { return folder_ / "jobs.json"; }
  std::filesystem::path job_script() const { return folder_ / "job.sh"; }
  std::filesystem::path lock() const { return folder_ / "lock"; }
  std::filesystem::path logs() const { return folder_ / "logs"; }
  /// Results, each whole: record.json and out/.
  std::filesystem::path result(const std::string& id) const {
    return folder_ / "cases" / id.substr(0, 2) / id;
  }
  /// What is being made, and may be half.
  std::filesystem::path parts() const { return folder_ / "parts"; }
  /// Why a case failed.
  std::filesystem::path failure(const std::string& id) const {
    return folder_ / "failed" / (id + ".json");
  }
  /// The records of a block that is done.
  std::filesystem::path blocks(const std::string& run) const { return folder_ / ("blocks_" + run); }
  std::filesystem::path block(const std::string& run, int number) const;

 private:
  std::filesystem::path folder_;
};

/// Jobs of Slurm that a run has handed in.
struct JobList {
  std::string run;                ///< TaskHead::run that they are for
  std::vector<std::string> jobs;  ///< "123"
};
/// An empty list where there is none, or where it cannot be understood.
JobList read_jobs(const RunFolder& folder);
void write_jobs(const RunFolder& folder, const JobList& jobs);

/// Block numbers as Slurm writes them: "0-3,7,9-12".
std::string ranges_of(const std::vector<int>& sorted);

}  // namespace pedicel::cluster
