#include "app/session/measured/measured_data.h"

#include <utility>

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

void MeasuredData::open(discrepancy::Experiment experiment) {
  take(std::move(experiment));
  shape_ = shape_of(experiment_->plant());
  run({discrepancy::nominal}, {{}}, {experiment_->plant().distance, first_dt});
}

void MeasuredData::close() {
  drop();
  shape_.clear();
}

void MeasuredData::run(const std::vector<Model>& models,
                       const std::vector<discrepancy::Variant>& variants,
                       const discrepancy::Numerics& numerics) {
  simulate(models, [experiment = experiment_, variants, numerics](const std::atomic<bool>& stop,
                                                                  const auto& done) {
    simulate_paths(*experiment, variants, numerics, stop, done);
  });
}

void MeasuredData::start_diagnosis(int threads, std::uint64_t seed) {
  begin_diagnosis([experiment = experiment_, threads = threads_for_diagnosis(threads), seed](
                      ProgressBoard& board, const std::atomic<bool>& stop) {
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

std::optional<plant::PlantFile> MeasuredData::extended_plant() const {
  using discrepancy::Outcome;
  if (!diagnosis_ || diagnosis_->verdict.outcome == Outcome::bad_data ||
      diagnosis_->verdict.outcome == Outcome::numerical)
    return std::nullopt;
  plant::PlantFile plant = discrepancy::extended_plant(*experiment_, diagnosis_->best.hypothesis);
  if (plant.effects == experiment_->plant().effects) return std::nullopt;
  return plant;
}

void MeasuredData::take_path(std::optional<TrialPath>& place, TrialPath path) {
  // What a diagnosis predicts is corrected for the mesh and the step: only the shape is new.
  if (place && diagnosis_)
    place->shape = std::move(path.shape);
  else
    place = std::move(path);
}

void MeasuredData::adopt_diagnosis() {
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
  run({discrepancy::refitted, discrepancy::extended},
      {d.base.hypothesis.variant(), d.best.hypothesis.variant()}, d.numerics);
}

}  // namespace pedicel::app
