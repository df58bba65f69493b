#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/session/measured/background_job.h"

namespace pedicel::app {

/// How far a diagnosis is.
struct DiagnosisProgress {
  std::string doing;               ///< "refitting candidates"
  double share = 0.0;              ///< 1, done; an estimate that only grows
  double seconds = 0.0;            ///< since it began
  std::optional<double> left;      ///< s, estimated; nothing as long as it is too early to say
  std::vector<std::string> found;  ///< each finding so far, a sentence
};

/// Where a diagnosis writes how far it is, and others read it. Calls from any thread.
class ProgressBoard {
 public:
  void tell(const std::string& doing, double share);
  void note(const std::string& sentence);
  DiagnosisProgress read() const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  mutable std::mutex mutex_;
  DiagnosisProgress progress_;  // under the mutex
};

/// `threads`, or for 0 all cores but one, which the picture keeps.
int threads_for_diagnosis(int threads);

/// A diagnosis on a thread of its own.
template <class Found>
class DiagnosisJob {
 public:
  /// Returns soon, with nothing, once the flag is set. What it throws becomes fault().
  using Work =
      std::function<std::optional<Found>(ProgressBoard& board, const std::atomic<bool>& stop)>;

  explicit DiagnosisJob(Work work)
      : job_([this, work = std::move(work)](const std::atomic<bool>& stop) {
          if (auto found = work(board_, stop))
            result_ = std::make_shared<const Found>(std::move(*found));
        }) {}

  DiagnosisProgress progress() const { return board_.read(); }
  /// Asks it to stop; it ends within some simulated trials.
  void cancel() { job_.stop(); }
  bool is_cancelled() const { return job_.was_stopped(); }
  bool has_ended() const { return job_.has_ended(); }
  const std::string& fault() const { return job_.fault(); }
  /// What it found out, once it has ended; null where it was cancelled or failed.
  std::shared_ptr<const Found> result() const { return has_ended() ? result_ : nullptr; }

 private:
  ProgressBoard board_;
  std::shared_ptr<const Found> result_;  // its thread's, until that has ended
  BackgroundJob job_;                    // last: ends before what it writes to
};

}  // namespace pedicel::app
