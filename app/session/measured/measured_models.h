#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/session/measured/diagnosis_job.h"
#include "app/session/measured/path_runs.h"
#include "engine/core/check.h"

namespace pedicel::app {

/// A measured experiment beside the session's document, of a plant or of a scene: what the models
/// say of its trials, and a diagnosis. Simulations and diagnoses run on threads of their own;
/// nothing waits for them. All calls from one thread.
template <class Experiment, class Path, class Found>
class MeasuredModels {
 public:
  MeasuredModels(const MeasuredModels&) = delete;
  MeasuredModels& operator=(const MeasuredModels&) = delete;

  /// Null: none is open.
  const Experiment* experiment() const { return experiment_.get(); }
  /// Grows when another experiment was opened or this one closed.
  int number() const { return number_; }

  /// Null: not known, or not yet.
  const Path* path(discrepancy::Model model, int trial) const {
    const auto& paths = paths_[static_cast<std::size_t>(model)];
    if (trial < 0 || trial >= static_cast<int>(paths.size())) return nullptr;
    const auto& one = paths[static_cast<std::size_t>(trial)];
    return one ? &*one : nullptr;
  }
  /// Whether a model has anything to show.
  bool has(discrepancy::Model model) const {
    return std::ranges::any_of(paths_[static_cast<std::size_t>(model)],
                               [](const auto& one) { return one.has_value(); });
  }
  /// Trials of models that are still being simulated.
  int still_simulated() const { return runs_.awaited(number_); }

  /// Asks it to stop; nothing where none runs.
  void cancel_diagnosis() {
    if (diagnosing_) diagnosing_->cancel();
  }
  bool is_diagnosing() const { return diagnosing_ != nullptr; }
  bool is_cancelling() const { return diagnosing_ && diagnosing_->is_cancelled(); }
  DiagnosisProgress progress() const {
    return diagnosing_ ? diagnosing_->progress() : DiagnosisProgress{};
  }
  /// The last one that came to an end; null: none did.
  const Found* diagnosis() const { return diagnosis_.get(); }

  /// Takes over what the threads have made; once a frame. What they could not do, a line each.
  std::vector<std::string> update() {
    std::vector<std::string> faults;
    std::erase_if(retired_, [](const auto& job) { return job->has_ended(); });
    take_diagnosis(faults);
    for (typename PathRuns<Path>::Made& made : runs_.take(number_, faults))
      take_path(paths_[static_cast<std::size_t>(made.model)][static_cast<std::size_t>(made.trial)],
                std::move(made.path));
    return faults;
  }
  /// Waits until nothing runs any more (scripts, tests).
  std::vector<std::string> wait() {
    std::vector<std::string> faults;
    do {
      for (std::string& fault : update()) faults.push_back(std::move(fault));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    } while (diagnosing_ || !runs_.none() || !retired_.empty());
    return faults;
  }

 protected:
  using Job = DiagnosisJob<Found>;
  using Paths = std::vector<std::optional<Path>>;  ///< by trial
  /// Simulates and hands over, until it is asked to stop.
  using Simulate =
      std::function<void(const std::atomic<bool>& stop,
                         const std::function<void(int trial, int variant, Path path)>& done)>;

  MeasuredModels() = default;
  ~MeasuredModels() = default;

  void take(Experiment experiment) {
    drop();
    experiment_ = std::make_shared<const Experiment>(std::move(experiment));
    for (Paths& paths : paths_) paths.resize(experiment_->trials.size());
  }
  /// What runs for the experiment is asked to stop, and waited for by nobody.
  void drop() {
    runs_.stop();
    if (diagnosing_) {
      diagnosing_->cancel();
      retired_.push_back(std::move(diagnosing_));
    }
    experiment_.reset();
    diagnosis_.reset();
    for (Paths& paths : paths_) paths.clear();
    ++number_;
  }
  /// `work` makes a path of every trial for every model, its variants in their order. It must hold
  /// the experiment itself: it may outlive this one's.
  void simulate(const std::vector<discrepancy::Model>& models, Simulate work) {
    runs_.start(number_, static_cast<int>(models.size() * experiment_->trials.size()),
                [models, work = std::move(work)](const std::atomic<bool>& stop,
                                                 const typename PathRuns<Path>::Done& done) {
                  work(stop, [&](int trial, int variant, Path path) {
                    done({models[static_cast<std::size_t>(variant)], trial, std::move(path)});
                  });
                });
  }
  /// Throws UsageError without an experiment, or where a diagnosis runs already.
  void begin_diagnosis(typename Job::Work work) {
    if (!experiment_)
      throw UsageError("no experiment is open, expected one (open experiment PATH)");
    if (diagnosing_)
      throw UsageError("a diagnosis runs already, expected it to end or be cancelled");
    diagnosing_ = std::make_unique<Job>(std::move(work));
  }

  std::shared_ptr<const Experiment> experiment_;
  std::array<Paths, discrepancy::model_count> paths_;
  std::shared_ptr<const Found> diagnosis_;

 private:
  /// A path that was made, into its place.
  virtual void take_path(std::optional<Path>& place, Path path) { place = std::move(path); }
  /// A diagnosis has come to its end.
  virtual void adopt_diagnosis() = 0;

  void take_diagnosis(std::vector<std::string>& faults) {
    if (!diagnosing_ || !diagnosing_->has_ended()) return;
    if (!diagnosing_->fault().empty()) faults.push_back(diagnosing_->fault());
    auto found = diagnosing_->result();
    diagnosing_.reset();
    if (!found) return;
    diagnosis_ = std::move(found);
    adopt_diagnosis();
  }

  int number_ = 0;
  PathRuns<Path> runs_;
  std::unique_ptr<Job> diagnosing_;
  std::vector<std::unique_ptr<Job>> retired_;  // asked to stop, not yet ended
};

}  // namespace pedicel::app
