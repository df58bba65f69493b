#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "app/session/measured/background_job.h"
#include "plugins/discrepancy/procedure/diagnosis.h"

namespace pedicel::app {

/// Simulations of an experiment's trials by models, on threads of their own, and what they have
/// made so far. All calls from one thread.
template <class Path>
class PathRuns {
 public:
  struct Made {
    discrepancy::Model model;
    int trial;
    Path path;
  };
  using Done = std::function<void(Made made)>;
  /// Calls `done`, from its own thread, for each path as soon as it is there.
  using Work = std::function<void(const std::atomic<bool>& stop, const Done& done)>;

  /// `number`: of the experiment it is for; `awaited`: the paths that it will make.
  void start(int number, int awaited, Work work) {
    runs_.push_back(std::make_unique<Run>(number, awaited, std::move(work)));
  }
  /// Asks all to stop, and waits for none.
  void stop() {
    for (const auto& run : runs_) run->job.stop();
  }
  bool none() const { return runs_.empty(); }
  /// Paths of that experiment that are not there yet.
  int awaited(int number) const {
    int count = 0;
    for (const auto& run : runs_)
      if (run->number == number) count += run->awaited;
    return count;
  }
  /// What was made for that experiment since the last call; what could not be done goes to
  /// `faults`.
  std::vector<Made> take(int number, std::vector<std::string>& faults) {
    std::vector<Made> all;
    for (const auto& run : runs_) {
      // Asked before taking: what it made last is there then.
      run->is_over = run->job.has_ended();
      if (run->number != number) continue;
      for (Made& made : run->take()) {
        --run->awaited;
        all.push_back(std::move(made));
      }
      if (run->is_over && !run->job.fault().empty()) faults.push_back(run->job.fault());
    }
    std::erase_if(runs_, [](const auto& run) { return run->is_over; });
    return all;
  }

 private:
  struct Run {
    Run(int of_number, int paths, Work work)
        : number(of_number),
          awaited(paths),
          job([this, work = std::move(work)](const std::atomic<bool>& stop) {
            work(stop, [this](Made one) {
              const std::lock_guard lock(mutex);
              made.push_back(std::move(one));
            });
          }) {}
    std::vector<Made> take() {
      const std::lock_guard lock(mutex);
      return std::exchange(made, {});
    }

    int number, awaited;
    bool is_over = false;  // and nothing is left to take
    std::mutex mutex;
    std::vector<Made> made;
    BackgroundJob job;  // last: ends before what it writes to
  };

  std::vector<std::unique_ptr<Run>> runs_;
};

}  // namespace pedicel::app
