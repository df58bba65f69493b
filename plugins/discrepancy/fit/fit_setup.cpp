#include "pedicel/discrepancy/fit/fit_setup.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pedicel/discrepancy/data/trial_split.h"
#include "pedicel/discrepancy/simulate/start_directions.h"

namespace pedicel::discrepancy {

FitSetup::FitSetup(const Experiment& experiment, int threads, const NoiseRule& rule,
                   const std::atomic<bool>* stop, const DiagnosisSettings& settings)
    : experiment_(&experiment),
      settings_(&settings),
      data_(experiment),
      rule_(rule),
      numerics_{.distance = 2.0 * experiment.plant.distance,
                .dt = 2.0 * accuracy().usual_dt,
                .quiet = accuracy().quiet_steps},
      threads_(threads),
      stop_(stop) {
  data_.choose_noise(measured_series(experiment), rule_);
  const TrialSplit split = split_trials(experiment);
  options_.settings = settings_;
  options_.iterations = settings.budget.iterations;
  options_.least_step = settings.budget.least_step;
  options_.trials = split.fit;
  check_ = split.check;
  renew();
}

Evaluator FitSetup::evaluator() {
  return Evaluator(*simulator_, data_, corrections());
}

std::vector<std::vector<Prediction>> FitSetup::predictions(std::span<const Hypothesis> hypotheses) {
  FitOptions all = options_;
  all.trials.resize(experiment_->trials.size());
  std::iota(all.trials.begin(), all.trials.end(), 0);
  return evaluator().predictions(hypotheses, all);
}

void FitSetup::renew() {
  if (simulator_) simulations_ += simulator_->simulations();
  simulator_ = std::make_unique<Simulator>(*experiment_, numerics_, threads_, stop_);
}

void FitSetup::renew_noise(const Hypothesis& model) {
  const auto predicted = predictions(std::span(&model, 1)).front();
  AllSeries left;
  for (std::size_t t = 0; t < predicted.size(); ++t)
    data_.raw_residuals(static_cast<int>(t), predicted[t], left);
  data_.choose_noise(left, rule_);
  find_start_directions(*simulator_, model.variant(), data_);
}

NumericsCheck FitSetup::refine(FitSummary& model, const Watch& watch) {
  for (int round = 0;; ++round) {
    watch.begin(round);
    NumericsCheck check = check_numerics(*experiment_, data_, model, numerics_, options_, threads_,
                                         simulations_, stop_);
    if (is_fine_enough(check) || round == settings_->budget.refinements || stopped()) {
      corrections_ = check.corrections;
      return check;
    }
    if (watch.too_coarse) watch.too_coarse(check);
    numerics_ = finer(check);
    renew();
    Evaluator with = evaluator();
    model = fit(with, model.hypothesis, options_);
  }
}

void FitSetup::correct_at(const FitSummary& model) {
  const double left = std::sqrt(2.0 * model.cost / std::max(1, samples()));
  for (int round = 0;; ++round) {
    NumericsCheck check = check_numerics(*experiment_, data_, model, numerics_, options_, threads_,
                                         simulations_, stop_);
    const bool is_masked = check.largest < accuracy().masked_error * left;
    if (is_fine_enough(check) || is_masked || round == settings_->budget.refinements || stopped()) {
      corrections_ = std::move(check.corrections);
      return;
    }
    numerics_ = finer(check);
    renew();
  }
}

bool FitSetup::is_coarse(const Numerics& numerics) const {
  return numerics.dt > accuracy().usual_dt || numerics.distance > experiment_->plant.distance;
}

bool FitSetup::is_fine_enough(const NumericsCheck& check) const {
  return check.largest <=
         (is_coarse(check.numerics) ? accuracy().allowed_coarse : accuracy().allowed_error);
}

// Nodes as in the file and usual steps come before anything finer than either.
Numerics FitSetup::finer(const NumericsCheck& check) const {
  const Numerics next = refined(check);
  Numerics usual = check.numerics;
  usual.distance = experiment_->plant.distance;
  usual.dt = accuracy().usual_dt;
  const bool beyond = next.dt < usual.dt || next.distance < usual.distance;
  return is_coarse(check.numerics) && beyond ? usual : next;
}

}  // namespace pedicel::discrepancy
