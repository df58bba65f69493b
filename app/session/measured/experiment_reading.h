#pragma once

#include <atomic>
#include <filesystem>
#include <optional>

#include "app/session/measured/background_job.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::app {

/// An experiment folder, of a plant or of a robot at plants, that is read on a thread of its own.
class ExperimentReading {
 public:
  explicit ExperimentReading(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  int trials_read() const { return done_; }
  int trials() const { return all_; }  ///< 0: not known yet
  /// It ends after the trial in hand; what was read is dropped.
  void cancel() { job_.stop(); }
  bool is_cancelled() const { return job_.was_stopped(); }
  bool has_ended() const { return job_.has_ended(); }

  // Once it has ended.
  /// Nothing where there were faults, or it was cancelled.
  std::optional<discrepancy::Experiment>& experiment() { return experiment_; }
  const Diagnostics& diagnostics() const { return diagnostics_; }
  const std::string& fault() const { return job_.fault(); }

 private:
  std::filesystem::path path_;
  std::atomic<int> done_{0}, all_{0};
  std::optional<discrepancy::Experiment> experiment_;
  Diagnostics diagnostics_;
  BackgroundJob job_;  // last: ends before what it writes to
};

}  // namespace pedicel::app
