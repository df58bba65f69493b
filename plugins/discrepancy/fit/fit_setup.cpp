#include "plugins/discrepancy/fit/fit_setup.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "plugins/discrepancy/data/trial_split.h"
#include "plugins/discrepancy/simulate/start_directions.h"

namespace pedicel::discrepancy {

FitSetup::FitSetup(const Experiment& experiment, int threads, const NoiseRule& rule,
                   const std::atomic<bool>* stop, const DiagnosisSettings& settings)
    : experiment_(&experiment),
      settings_(&settings),
      data_(experiment),
      rule_(rule),
      // Coarser than the file and than usual: most data do not tell the difference, and every fit
      // then takes a part of the time. refine() decides whether it does.
      numerics_{.distance = 2.0 * experiment.plant().distance,
                .dt = 2.0 * accuracy().usual_dt,
                .quiet = accuracy().quiet_steps},
      threads_(threads),
      stop_(stop) {
  // Before anything was simulated, from the data alone: the first fit has to weigh them by
  // something. All trials tell it, those held out as well: it is the instruments' and says nothing
  // of the plant.
  data_.choose_noise(measured_series(experiment), rule_);
  const TrialSplit split = split_trials(experiment);
  options_.settings = settings_;
  options_.iterations = settings.budget.iterations;
  options_.least_step = settings.budget.least_step;
  // Held-out trials are kept from all fits here, once, and not by everyone who fits.
  options_.trials = split.fit;
  check_ = split.check;
  renew();
}

Evaluator FitSetup::evaluator() {
  // Made anew for each use: it refers to the simulator and to the corrections, which a refinement
  // replaces.
  return Evaluator(*simulator_, data_, corrections());
}

std::vector<std::vector<Prediction>> FitSetup::predictions(std::span<const Hypothesis> hypotheses) {
  FitOptions all = options_;
  // Held-out trials, too: these are for looking at, not for fitting.
  all.trials.resize(experiment_->trials.size());
  std::iota(all.trials.begin(), all.trials.end(), 0);
  return evaluator().predictions(hypotheses, all);
}

void FitSetup::renew() {
  // Counted before it goes. The motions that it kept go with it.
  if (simulator_) simulations_ += simulator_->simulations();
  simulator_ = std::make_unique<Simulator>(*experiment_, numerics_, threads_, stop_);
}

void FitSetup::renew_noise(const Hypothesis& model) {
  const auto predicted = predictions(std::span(&model, 1)).front();
  AllSeries left;
  for (std::size_t t = 0; t < predicted.size(); ++t)
    data_.raw_residuals(static_cast<int>(t), predicted[t], left);
  // From residuals, because what the data do in motion is not noise. With a poor model this takes
  // its errors for noise, so it comes after a fit.
  data_.choose_noise(left, rule_);
  // A trial in mid swing answers to how it began as the plant swings, which the new model says
  // anew.
  find_start_directions(*simulator_, model.variant(), data_);
}

NumericsCheck FitSetup::refine(FitSummary& model, const Watch& watch) {
  for (int round = 0;; ++round) {
    watch.begin(round);
    NumericsCheck check = check_numerics(*experiment_, data_, model, numerics_, options_, threads_,
                                         simulations_, stop_);
    // The check is made before every refinement, so corrections are always those of the mesh that
    // is used. Where the budget ends they are kept, too: the caller hears how large the error is
    // and judges it.
    if (is_fine_enough(check) || round == settings_->budget.refinements || stopped()) {
      corrections_ = check.corrections;
      return check;
    }
    if (watch.too_coarse) watch.too_coarse(check);
    numerics_ = finer(check);
    renew();
    Evaluator with = evaluator();
    // A mesh errs by how the plant moves, and the model that was fitted with the coarser one moves
    // by its errors. The next check is about a model that is right for its own mesh.
    model = fit(with, model.hypothesis, options_);
  }
}

void FitSetup::correct_at(const FitSummary& model) {
  // In noise units a sample: what this model misses the data by.
  const double left = std::sqrt(2.0 * model.cost / std::max(1, samples()));
  for (int round = 0;; ++round) {
    NumericsCheck check = check_numerics(*experiment_, data_, model, numerics_, options_, threads_,
                                         simulations_, stop_);
    // A small part of what is left changes no decision. Else a model that is poor for its physics
    // would ask for ever finer meshes, and stay as poor.
    const bool is_masked = check.largest < accuracy().masked_error * left;
    if (is_fine_enough(check) || is_masked || round == settings_->budget.refinements || stopped()) {
      corrections_ = std::move(check.corrections);
      return;
    }
    // The model is not fitted again here: only predictions about it are to be right, and whoever
    // asked goes on to fit it.
    numerics_ = finer(check);
    renew();
  }
}

bool FitSetup::is_coarse(const Numerics& numerics) const {
  // Either is enough: half of a coarse pair is not what the limits of usual ones were measured
  // with.
  return numerics.dt > accuracy().usual_dt || numerics.distance > experiment_->plant().distance;
}

bool FitSetup::is_fine_enough(const NumericsCheck& check) const {
  // Coarser ones must err by less, because their correction is worth less: near junctions
  // Richardson's law holds for them only roughly.
  return check.largest <=
         (is_coarse(check.numerics) ? accuracy().allowed_coarse : accuracy().allowed_error);
}

// Nodes as in the file and usual steps come before anything finer than either.
Numerics FitSetup::finer(const NumericsCheck& check) const {
  // A step shorter than usual on a mesh coarser than the file's leaves most of the error where it
  // was, for all its time: by that a beam of silicone that was measured came out as unknown.
  const Numerics next = refined(check);
  Numerics usual = check.numerics;
  usual.distance = experiment_->plant().distance;
  usual.dt = accuracy().usual_dt;
  const bool beyond = next.dt < usual.dt || next.distance < usual.distance;
  return is_coarse(check.numerics) && beyond ? usual : next;
}

}  // namespace pedicel::discrepancy
