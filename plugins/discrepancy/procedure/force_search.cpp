#include "plugins/discrepancy/procedure/force_search.h"

namespace pedicel::discrepancy {

const MissingForce& ForceSearch::find(double from, double least_evidence) {
  if (force_) return *force_;
  state_.log.say("looking for a force that is missing", from);
  check_.anchor_at(state_.result.base);
  // Refits are fine ones: a force moves the model so far from the base that a coarse one, which
  // agrees with it there alone, misleads about the place.
  Evaluator evaluator = state_.setup->evaluator();
  // The noise was read anew since the base was fitted.
  const FitSummary base = fit(evaluator, state_.result.base.hypothesis, state_.fit_options());
  MissingForceOptions options;
  options.fit = state_.fit_options();
  options.check = state_.result.check_trials;
  options.threads = state_.options.threads;
  options.response_distance = state_.simulators->coarse().numerics().distance;
  options.least_evidence = least_evidence;
  if (state_.base_misses_the_data())
    options.correct_at = [&](const FitSummary& model) {
      state_.correct_at(model);
      evaluator = state_.setup->evaluator();
    };
  options.note = [this](const std::string& sentence) { state_.log.note(sentence); };
  force_ = infer_missing_force(evaluator, base, options);
  state_.result.verdict.simulations += force_->simulations;
  return *force_;
}

}  // namespace pedicel::discrepancy
