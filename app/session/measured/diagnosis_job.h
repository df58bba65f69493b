#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/app/session/measured/background_job.h"
#include "pedicel/discrepancy/procedure/diagnosis.h"

namespace pedicel::app {

/// How far a diagnosis is.
struct DiagnosisProgress {
  std::string doing;               ///< "refitting candidates"
  double share = 0.0;              ///< 1, done; an estimate that only grows
  double seconds = 0.0;            ///< since it began
  std::optional<double> left;      ///< s, estimated; nothing as long as it is too early to say
  std::vector<std::string> found;  ///< each finding so far, a sentence
};

/// A diagnosis on a thread of its own.
class DiagnosisJob {
 public:
  /// `threads` of its own work on it.
  DiagnosisJob(std::shared_ptr<const discrepancy::Experiment> experiment, int threads,
               std::uint64_t seed);

  DiagnosisProgress progress() const;
  /// Asks it to stop; it ends within some simulated trials.
  void cancel() { job_.stop(); }
  bool is_cancelled() const { return job_.was_stopped(); }
  bool has_ended() const { return job_.has_ended(); }
  const std::string& fault() const { return job_.fault(); }
  /// What it found out; null where it was cancelled or failed, and before it has ended.
  std::shared_ptr<const discrepancy::Diagnosis> result() const;

 private:
  void work(const discrepancy::Experiment& experiment, int threads, std::uint64_t seed,
            const std::atomic<bool>& stop);

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  mutable std::mutex mutex_;
  DiagnosisProgress progress_;                            // under the mutex
  std::shared_ptr<const discrepancy::Diagnosis> result_;  // under the mutex
  BackgroundJob job_;                                     // last: ends before what it writes to
};

}  // namespace pedicel::app
