#include <algorithm>

#include "pedicel/discrepancy/data/sentence.h"
#include "pedicel/discrepancy/procedure/conclusion.h"
#include "pedicel/discrepancy/procedure/diagnosis_procedure.h"
#include "pedicel/discrepancy/procedure/shares.h"
#include "pedicel/discrepancy/select/evidence.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

bool stands_at_bound(const Candidate& found) {
  const Hypothesis& model = found.fit.hypothesis;
  return std::ranges::any_of(found.fit.at_bound, [&](int p) {
    return model.effects[model.free[p].effect].name == found.cause;
  });
}

}  // namespace

void Procedure::conclude_all() {
  log_.say("writing the verdict", 0.95);
  findings_.step = result_.numerics.dt;
  if (findings_.chain.size() > 1) findings_.held_out = held_out_by(result_.best);
  // What is left of the best model is the best sample of the noise.
  if (!findings_.chain.empty()) setup_->renew_noise(result_.best.hypothesis);
  if (findings_.chain.empty() && instead_of_.empty()) {
    Evaluator evaluator = setup_->evaluator();
    findings_.needed =
        needed_parameters(evaluator, result_.base, causes_, fit_options(), result_.check_trials);
    if (const FitSummary* law = findings_.needed.better()) result_.best = *law;
  }
  predict();
  measure_errors(findings_, result_);
  findings_.symptoms = symptoms(experiment(), setup_->data(), result_.predictions[refitted]);
  conclude(findings_, result_);
  if (result_.verdict.causes.empty() && findings_.needed.better()) {
    // What a law stood for may be nominal, but for our own errors: then nothing is extended.
    predict();
    measure_errors(findings_, result_);
  }
  if (objecting_ >= 0) {
    name_nothing(result_.verdict);
    result_.verdict.outcome = Outcome::unknown;
    result_.verdict.remainder = "the refitted model explains the fitted trials, but not trial " +
                                experiment().trials[objecting_].name +
                                ", which is held out: fit it, too";
  } else if (result_.verdict.outcome == Outcome::unknown) {
    if (!instead_of_.empty()) result_.verdict.remainder = instead_of_ + ", one force far less";
    tell_of_force();
  } else if (!findings_.chain.empty()) {
    ask_for_one_force();
  }
  if (!stopped()) {
    log_.say("weighing what explains how much", 0.97);
    Evaluator evaluator = setup_->evaluator();
    tell_shares(evaluator, findings_, fit_options(), result_);
  }
  conclude_outliers(result_);
  judge_stalks();
  report_parameters(findings_, result_);
  report_detectable_limits(causes_, result_);
  choose_next();
}

// What several causes do together for the held-out trials.
HeldOut Procedure::held_out_by(const FitSummary& model) {
  if (result_.check_trials.empty()) return {};
  Evaluator evaluator = setup_->evaluator();
  FitOptions check = fit_options();
  check.trials = result_.check_trials;
  const HeldOutModel base = held_out_model(evaluator, result_.base, check);
  const std::array extended{held_out_model(evaluator, model, check)};
  const double dispersion = std::max(1.0, 2.0 * model.cost / setup_->samples());
  return held_out(base, extended, setup_->data().samples(check.trials), dispersion).front();
}

// Several causes are none where one force from outside the list explains as much of the fitted
// trials, nor is one that does so at the end of what its numbers may be; any other single cause
// is none where a force explains clearly more. That holds for the held-out trials, too. What is
// explained to the last, and with a large gain, is not by chance.
void Procedure::ask_for_one_force() {
  const Evidence& weights = options_.settings.evidence;
  const bool several = findings_.chain.size() > 1;
  const bool alone = !several && !stands_at_bound(findings_.chain.front());
  const Candidate& first = findings_.chain.front();
  double explained = first.evidence - first.held_out.gain;
  for (std::size_t c = 1; c < findings_.chain.size(); ++c) explained += findings_.chain[c].gain;
  if ((!result_.after.raised || is_small(result_.after)) &&
      explained > (several ? weights.beyond_doubt_together : weights.beyond_doubt))
    return;
  const MissingForce& force =
      missing_force(0.96, weights.worthwhile_force * (result_.base.cost - result_.best.cost));
  if (!force.found || force.fit.why == "not run") return;
  // With the noise as it was read last.
  Evaluator evaluator = setup_->evaluator();
  const std::vector<Hypothesis> models{result_.base.hypothesis, result_.best.hypothesis,
                                       force.fit.hypothesis};
  const Eigen::VectorXd cost =
      0.5 * evaluator.residuals(models, fit_options()).colwise().squaredNorm();
  const double by_causes = cost[0] - cost[1], by_force = cost[0] - cost[2];
  log_.note(text("One force gains %.4g nats, what was found %.4g.", by_force, by_causes));
  const double margin =
      std::max(options_.settings.levels.clear_margin, weights.force_share * by_causes);
  if (by_force < by_causes + (alone ? margin : -margin)) return;
  const std::optional<double>& gain = result_.verdict.gain;
  if (gain && force.gain && *force.gain < *gain - (alone ? 0.0 : weights.force_share)) return;
  result_.verdict.outcome = Outcome::unknown;
  result_.verdict.remainder =
      several ? "one force explains as much as several known causes together"
      : alone ? "one force explains more than any known cause"
              : "one force explains as much as a known cause that stands at the end of what its "
                "numbers may be";
  tell_of_force();
}

// Where, when and of what kind the force is that no cause stands for; none where even a free one
// scores too little.
const MissingForce& Procedure::missing_force(double from, double least_evidence) {
  if (force_) return *force_;
  log_.say("looking for a force that is missing", from);
  anchor_at(result_.base);
  // Refits are fine ones: a force moves the model so far from the base that a coarse one, which
  // agrees with it there alone, misleads about the place.
  Evaluator evaluator = setup_->evaluator();
  // The noise was read anew since the base was fitted.
  const FitSummary base = fit(evaluator, result_.base.hypothesis, fit_options());
  MissingForceOptions options;
  options.fit = fit_options();
  options.check = result_.check_trials;
  options.threads = options_.threads;
  options.response_distance = simulators_->coarse().numerics().distance;
  options.least_evidence = least_evidence;
  if (base_misses_the_data())
    options.correct_at = [&](const FitSummary& model) {
      correct_at(model);
      evaluator = setup_->evaluator();
    };
  options.note = [this](const std::string& sentence) { log_.note(sentence); };
  force_ = infer_missing_force(evaluator, base, options);
  result_.verdict.simulations += force_->simulations;
  return *force_;
}

void Procedure::tell_of_force() {
  const MissingForce& force = result_.force = missing_force(0.96);
  name_nothing(result_.verdict);
  std::string& remainder = result_.verdict.remainder;
  if (!remainder.empty()) remainder += ". ";
  remainder +=
      force.found ? force.sentence() : "No force at a marker explains it. Do not extrapolate.";
  if (force.fit.why == "not run" || stopped()) return;
  anchor_at(force.fit);
  std::vector<Direction> left = directions_at(force.fit);
  const Alarm alarm = judged(left, force.fit);
  log_.note(text("With that force the largest directed statistic is %.3g, level %.3g.",
                 alarm.statistic, alarm.level));
}

// What the stalks bore and broke at, by the best model, against the file's thresholds.
void Procedure::judge_stalks() {
  if (!records_detachments(experiment()) || stopped()) return;
  const Variant variant = result_.best.hypothesis.variant();
  // The moment under a fruit depends on how far below it the next joint is: here as where the
  // law will be used, with the plant file's own nodes.
  Numerics own = result_.numerics;
  own.distance = experiment().plant.distance;
  own.junction = 0.0;
  Simulator simulator(experiment(), own, 1, options_.stop);
  std::vector<StalkLoads> stalks;
  std::vector<BreakLaw> thresholds;
  std::vector<double> intervals;
  for (int t = 0; t < static_cast<int>(experiment().trials.size()); ++t) {
    const std::vector<double>& time = experiment().trials[t].markers.time;
    for (std::size_t i = 1; i < time.size(); ++i) intervals.push_back(time[i] - time[i - 1]);
    std::ranges::move(simulator.stalk_loads(variant, t), std::back_inserter(stalks));
    for (const plant::PlantFruit& fruit : experiment().plant.fruits)
      thresholds.push_back(break_law_of(experiment().plant, fruit));
  }
  result_.verdict.simulations += simulator.simulations();
  if (intervals.empty()) return;
  std::ranges::nth_element(intervals, intervals.begin() + intervals.size() / 2);
  // Seen with the next sample.
  const double window = intervals[intervals.size() / 2];
  result_.strength =
      judge_strength(std::move(stalks), std::move(thresholds), window, options_.settings);
  log_.note(result_.strength.summary());
  conclude_detachment(result_);
}

void Procedure::choose_next() {
  Verdict& verdict = result_.verdict;
  if (verdict.outcome == Outcome::ambiguous) {
    log_.say("choosing the next experiment", 0.97);
    std::vector<Hypothesis> models;
    for (const NamedCause& cause : verdict.causes)
      if (std::ssize(models) < options_.settings.budget.competing_models)
        models.push_back(model_of(cause.name));
    result_.next =
        next_experiment(experiment(), setup_->data(), models,
                        {result_.numerics, options_.threads, options_.stop, options_.settings},
                        verdict.simulations);
  } else if (verdict.outcome == Outcome::unknown) {
    result_.next = next_look(experiment(), setup_->data(), result_.predictions[refitted]);
  }
  verdict.next_experiment = result_.next.sentence;
}

// Refitted with a cause that the verdict lists: a candidate, or what may stand for a parameter.
Hypothesis Procedure::model_of(const std::string& cause) const {
  const FitSummary* found = &findings_.needed.model;
  for (const Candidate& candidate : result_.ranking)
    if (candidate.cause == cause) found = &candidate.fit;
  for (const NeededParameters::Instead& other : findings_.needed.instead)
    if (other.model.hypothesis.name == cause) found = &other.model;
  Hypothesis model = found->hypothesis;
  model.name = cause;
  return model;
}

void Procedure::predict() {
  const std::array<Hypothesis, model_count> models{Hypothesis{}, result_.base.hypothesis,
                                                   result_.best.hypothesis};
  auto all = setup_->predictions(models);
  for (int m = 0; m < model_count; ++m) result_.predictions[m] = std::move(all[m]);
}

}  // namespace pedicel::discrepancy
