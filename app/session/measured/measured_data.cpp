#include "pedicel/app/session/measured/measured_data.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "pedicel/core/check.h"

namespace pedicel::app {

namespace {

using discrepancy::Model;

// As a diagnosis begins; fine enough to look at.
constexpr double first_dt = 1.0 / 480.0;  // s

}  // namespace

const char* model_name(Model model) {
  constexpr std::array<const char*, discrepancy::model_count> names = {"nominal", "refitted",
                                                                       "extended"};
  return names[static_cast<std::size_t>(model)];
}

MeasuredData::MeasuredData() = default;
MeasuredData::~MeasuredData() = default;

void MeasuredData::open(discrepancy::Experiment experiment) {
  close();
  experiment_ = std::make_shared<const discrepancy::Experiment>(std::move(experiment));
  shape_ = shape_of(experiment_->plant);
  for (auto& paths : paths_) paths.resize(experiment_->trials.size());
  simulate({discrepancy::nominal}, {{}}, {experiment_->plant.distance, first_dt});
}

void MeasuredData::close() {
  retire();
  experiment_.reset();
  diagnosis_.reset();
  shape_.clear();
  for (auto& paths : paths_) paths.clear();
  ++number_;
}

/// What runs for another experiment is asked to stop, and waited for by nobody.
void MeasuredData::retire() {
  runs_.stop();
  if (!diagnosing_) return;
  diagnosing_->cancel();
  retired_.push_back(std::move(diagnosing_));
}

void MeasuredData::simulate(const std::vector<Model>& models,
                            const std::vector<discrepancy::Variant>& variants,
                            const discrepancy::Numerics& numerics) {
  runs_.start(number_, static_cast<int>(models.size() * experiment_->trials.size()),
              [experiment = experiment_, models, variants, numerics](
                  const std::atomic<bool>& stop, const PathRuns<TrialPath>::Done& done) {
                simulate_paths(
                    *experiment, variants, numerics, stop,
                    [&](int trial, int variant, TrialPath path) {
                      done({models[static_cast<std::size_t>(variant)], trial, std::move(path)});
                    });
              });
}

const TrialPath* MeasuredData::path(Model model, int trial) const {
  const auto& paths = paths_[static_cast<std::size_t>(model)];
  if (trial < 0 || trial >= static_cast<int>(paths.size())) return nullptr;
  const auto& one = paths[static_cast<std::size_t>(trial)];
  return one ? &*one : nullptr;
}

bool MeasuredData::has(Model model) const {
  const auto& paths = paths_[static_cast<std::size_t>(model)];
  return std::ranges::any_of(paths, [](const auto& one) { return one.has_value(); });
}

int MeasuredData::still_simulated() const {
  return runs_.awaited(number_);
}

void MeasuredData::start_diagnosis(int threads, std::uint64_t seed) {
  if (!experiment_) throw UsageError("no experiment is open, expected one (open experiment PATH)");
  if (diagnosing_) throw UsageError("a diagnosis runs already, expected it to end or be cancelled");
  diagnosing_ = std::make_unique<Job>([experiment = experiment_,
                                       threads = threads_for_diagnosis(threads),
                                       seed](ProgressBoard& board, const std::atomic<bool>& stop) {
    discrepancy::DiagnosisOptions options;
    options.threads = threads;
    options.seed = seed;
    options.stop = &stop;
    options.progress = [&](const std::string& doing, double share) { board.tell(doing, share); };
    options.note = [&](const std::string& sentence) { board.note(sentence); };
    discrepancy::Diagnosis found = discrepancy::diagnose(*experiment, options);
    return found.stopped ? std::nullopt : std::optional(std::move(found));
  });
}

void MeasuredData::cancel_diagnosis() {
  if (diagnosing_) diagnosing_->cancel();
}

DiagnosisProgress MeasuredData::progress() const {
  return diagnosing_ ? diagnosing_->progress() : DiagnosisProgress{};
}

std::optional<plant::PlantFile> MeasuredData::extended_plant() const {
  using discrepancy::Outcome;
  if (!diagnosis_ || diagnosis_->verdict.outcome == Outcome::bad_data ||
      diagnosis_->verdict.outcome == Outcome::numerical)
    return std::nullopt;
  plant::PlantFile plant = discrepancy::extended_plant(*experiment_, diagnosis_->best.hypothesis);
  if (plant.effects == experiment_->plant.effects) return std::nullopt;
  return plant;
}

std::vector<std::string> MeasuredData::update() {
  std::vector<std::string> faults;
  std::erase_if(retired_, [](const auto& job) { return job->has_ended(); });
  take_diagnosis(faults);
  take_paths(faults);
  return faults;
}

void MeasuredData::take_paths(std::vector<std::string>& faults) {
  for (PathRuns<TrialPath>::Made& made : runs_.take(number_, faults)) {
    auto& place =
        paths_[static_cast<std::size_t>(made.model)][static_cast<std::size_t>(made.trial)];
    // What a diagnosis predicts is corrected for the mesh and the step: only the shape is new.
    if (place && diagnosis_)
      place->shape = std::move(made.path.shape);
    else
      place = std::move(made.path);
  }
}

void MeasuredData::take_diagnosis(std::vector<std::string>& faults) {
  if (!diagnosing_ || !diagnosing_->has_ended()) return;
  if (!diagnosing_->fault().empty()) faults.push_back(diagnosing_->fault());
  const auto found = diagnosing_->result();
  diagnosing_.reset();
  if (!found) return;
  diagnosis_ = found;
  adopt_predictions();
}

void MeasuredData::adopt_predictions() {
  const discrepancy::Diagnosis& d = *diagnosis_;
  for (std::size_t m = 0; m < paths_.size(); ++m)
    for (std::size_t t = 0; t < d.predictions[m].size() && t < paths_[m].size(); ++t) {
      if (d.predictions[m][t].markers.rows() != experiment_->trials[t].markers.size()) continue;
      TrialPath path;
      if (paths_[m][t] && m == discrepancy::nominal) path.shape = std::move(paths_[m][t]->shape);
      path.markers = d.predictions[m][t].markers;
      path.force = d.predictions[m][t].force;
      path.healthy = d.predictions[m][t].healthy;
      measure_error(experiment_->trials[t], path);
      paths_[m][t] = std::move(path);
    }
  if (d.predictions[discrepancy::extended].empty()) return;
  simulate({discrepancy::refitted, discrepancy::extended},
           {d.base.hypothesis.variant(), d.best.hypothesis.variant()}, d.numerics);
}

std::vector<std::string> MeasuredData::wait() {
  std::vector<std::string> faults;
  do {
    for (std::string& fault : update()) faults.push_back(std::move(fault));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  } while (diagnosing_ || !runs_.none() || !retired_.empty());
  return faults;
}

}  // namespace pedicel::app
