#include "plugins/discrepancy/procedure/verdict_writer.h"

#include <algorithm>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/procedure/conclusion.h"
#include "plugins/discrepancy/procedure/seen_ratios.h"
#include "plugins/discrepancy/procedure/shares.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/discrepancy/select/symptom_numbers.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

bool stands_at_bound(const Candidate& found) {
  const Hypothesis& model = found.fit.hypothesis;
  return std::ranges::any_of(found.fit.at_bound, [&](int p) {
    return model.effects[model.free[p].effect].name == found.cause;
  });
}

}  // namespace

void VerdictWriter::write(const std::string& instead_of, int objecting) {
  state_.log.say("writing the verdict", 0.92);
  state_.findings.step = state_.result.numerics.dt;
  if (state_.findings.chain.size() > 1)
    state_.findings.held_out = state_.held_out_by(state_.result.best);
  // What is left of the best model is the best sample of the noise.
  if (!state_.findings.chain.empty()) state_.setup->renew_noise(state_.result.best.hypothesis);
  if (state_.findings.chain.empty() && instead_of.empty()) see_what_is_needed();
  // Predicted with the fine simulator, since these numbers are shown.
  predict();
  measure_errors(state_.findings, state_.result);
  state_.findings.symptoms =
      symptoms(state_.experiment(), state_.setup->data(), state_.result.predictions[refitted]);
  conclude(state_.findings, state_.result);
  if (state_.result.verdict.causes.empty() && state_.findings.needed.better()) {
    // What a law stood for may be nominal, but for our own errors: then nothing is extended.
    predict();
    measure_errors(state_.findings, state_.result);
  }
  judge_named(instead_of, objecting);
  tell_left(state_.findings, state_.result);
  if (!state_.stopped()) {
    state_.log.say("weighing what explains how much", 0.94);
    Evaluator evaluator = state_.setup->evaluator();
    tell_shares(evaluator, state_.findings, state_.fit_options(), state_.result);
  }
  // Beside whatever else was concluded, since these were left out before all fits.
  conclude_outliers(state_.result);
  judge_stalks();
  report_parameters(state_.findings, state_.result);
  report_ratios(state_.findings, state_.result);
  report_detectable_limits(state_.causes, state_.result);
  state_.result.verdict.symptoms = symptom_numbers(state_.findings.symptoms);
  choose_next();
}

void VerdictWriter::write_partial() {
  Verdict& verdict = state_.result.verdict;
  verdict = {};
  verdict.partial = true;
  verdict.outcome = Outcome::unknown;
  if (!state_.setup || state_.result.base.why == "not run") {
    verdict.remainder = "the search was cut short before modulus, density and damping were fitted";
    return;
  }
  std::vector<Candidate>& chain = state_.findings.chain;
  if (chain.empty()) state_.result.best = state_.result.base;
  predict();
  measure_errors(state_.findings, state_.result);
  state_.findings.symptoms =
      symptoms(state_.experiment(), state_.setup->data(), state_.result.predictions[refitted]);
  const std::string cut = "the search was cut short ";
  if (!chain.empty()) {
    // Nobody asked yet what else there is, or whether one force explains as much.
    conclude(state_.findings, state_.result);
    verdict.remainder =
        cut + "after the first cause" + (verdict.remainder.empty() ? "" : "; " + verdict.remainder);
  } else {
    verdict.remainder = cut + (state_.result.before.raised ? "while causes were refitted"
                                                           : "before causes were looked for");
    verdict.gain = verdict.gain_over_nominal = {};
    const auto& ranking = state_.result.ranking;
    if (!ranking.empty() && ranking.front().whole) {
      const FitSummary& fit = ranking.front().fit;
      const int effect = static_cast<int>(state_.result.base.hypothesis.effects.size());
      verdict.nearest = {state_.findings.named(ranking.front(), fit, effect, verdict.fit)};
      verdict.nearest.front().against = "not all causes were refitted";
    }
  }
  tell_left(state_.findings, state_.result);
  report_parameters(state_.findings, state_.result);
  report_ratios(state_.findings, state_.result);
  verdict.symptoms = symptom_numbers(state_.findings.symptoms);
  report_detectable_limits(state_.causes, state_.result);
}

// Without a cause, whether a parameter has to leave its nominal value, or a law stands for it.
void VerdictWriter::see_what_is_needed() {
  Evaluator evaluator = state_.setup->evaluator();
  state_.findings.needed = needed_parameters(evaluator, state_.result.base, state_.causes,
                                             state_.fit_options(), state_.result.check_trials);
  if (const FitSummary* law = state_.findings.needed.better()) state_.result.best = *law;
}

// What was concluded stands only where no held-out trial and no single force speaks against it.
void VerdictWriter::judge_named(const std::string& instead_of, int objecting) {
  Verdict& verdict = state_.result.verdict;
  if (objecting >= 0) {
    name_nothing(verdict);
    verdict.outcome = Outcome::unknown;
    verdict.remainder = "the refitted model explains the fitted trials, but not trial " +
                        state_.experiment().trials[objecting].name +
                        ", which is held out: fit it, too";
  } else if (verdict.outcome == Outcome::unknown) {
    if (!instead_of.empty()) verdict.remainder = instead_of + ", one force far less";
    tell_of_force();
  } else if (!state_.findings.chain.empty()) {
    ask_for_one_force();
  }
}

// Several causes are none where one force from outside the list explains as much of the fitted
// trials, nor is one that does so at the end of what its numbers may be; any other single cause
// is none where a force explains clearly more. That holds for the held-out trials, too. What is
// explained to the last, and with a large gain, is not by chance.
void VerdictWriter::ask_for_one_force() {
  const Evidence& weights = state_.settings().evidence;
  const bool several = state_.findings.chain.size() > 1;
  const bool alone = !several && !stands_at_bound(state_.findings.chain.front());
  const Candidate& first = state_.findings.chain.front();
  double explained = first.evidence - first.held_out.gain;
  for (std::size_t c = 1; c < state_.findings.chain.size(); ++c)
    explained += state_.findings.chain[c].gain;
  if ((!state_.result.after.raised || check_.leaves_little(state_.result.after)) &&
      explained > (several ? weights.beyond_doubt_together : weights.beyond_doubt))
    return;
  const MissingForce& force = force_.find(
      0.94, weights.worthwhile_force * (state_.result.base.cost - state_.result.best.cost));
  // Then what was named stands.
  if (!force.found || force.fit.why == "not run") return;
  // With the noise as it was read last.
  Evaluator evaluator = state_.setup->evaluator();
  const std::vector<Hypothesis> models{state_.result.base.hypothesis, state_.result.best.hypothesis,
                                       force.fit.hypothesis};
  const Eigen::VectorXd cost =
      0.5 * evaluator.residuals(models, state_.fit_options()).colwise().squaredNorm();
  const double by_causes = cost[0] - cost[1], by_force = cost[0] - cost[2];
  state_.log.note(text("One force gains %.4g nats, what was found %.4g.", by_force, by_causes));
  const double margin =
      std::max(state_.settings().levels.clear_margin, weights.force_share * by_causes);
  if (by_force < by_causes + (alone ? margin : -margin)) return;
  const std::optional<double>& gain = state_.result.verdict.gain;
  if (gain && force.gain && *force.gain < *gain - (alone ? 0.0 : weights.force_share)) return;
  state_.result.verdict.outcome = Outcome::unknown;
  state_.result.verdict.remainder =
      several ? "one force explains as much as several known causes together"
      : alone ? "one force explains more than any known cause"
              : "one force explains as much as a known cause that stands at the end of what its "
                "numbers may be";
  tell_of_force();
}

void VerdictWriter::tell_of_force() {
  const MissingForce& force = state_.result.force = force_.find(0.94);
  name_nothing(state_.result.verdict);
  std::string& remainder = state_.result.verdict.remainder;
  if (!remainder.empty()) remainder += ". ";
  remainder += force.found || !force.refused.empty()
                   ? force.sentence()
                   : "No force at a marker explains it. Do not extrapolate.";
  if (force.fit.why == "not run" || state_.stopped()) return;
  check_.anchor_at(force.fit);
  std::vector<Direction> left = check_.directions_at(force.fit);
  const Alarm alarm = check_.judged(left, force.fit);
  state_.log.note(text("With that force the largest directed statistic is %.3g, level %.3g.",
                       alarm.statistic, alarm.level));
}

// What the stalks bore and broke at, by the best model, against the file's thresholds.
void VerdictWriter::judge_stalks() {
  if (!records_detachments(state_.experiment()) || state_.stopped()) return;
  const Variant variant = state_.result.best.hypothesis.variant();
  // The moment under a fruit depends on how far below it the next joint is: here as where the
  // law will be used, with the plant file's own nodes.
  Numerics own = state_.result.numerics;
  own.distance = state_.experiment().plant().distance;
  own.junction = 0.0;
  Simulator simulator(state_.experiment(), own, 1, state_.options.stop);
  std::vector<StalkLoads> stalks;
  std::vector<BreakLaw> thresholds;
  std::vector<double> intervals;
  for (int t = 0; t < static_cast<int>(state_.experiment().trials.size()); ++t) {
    const std::vector<double>& time = state_.experiment().trials[t].markers.time;
    for (std::size_t i = 1; i < time.size(); ++i) intervals.push_back(time[i] - time[i - 1]);
    std::ranges::move(simulator.stalk_loads(variant, t), std::back_inserter(stalks));
    for (const plant::PlantFruit& fruit : state_.experiment().plant().fruits)
      thresholds.push_back(break_law_of(state_.experiment().plant(), fruit));
  }
  state_.result.verdict.simulations += simulator.simulations();
  if (intervals.empty()) return;
  std::ranges::nth_element(intervals, intervals.begin() + intervals.size() / 2);
  // Seen with the next sample.
  const double window = intervals[intervals.size() / 2];
  state_.result.strength =
      judge_strength(std::move(stalks), std::move(thresholds), window, state_.settings());
  state_.log.note(state_.result.strength.summary());
  conclude_detachment(state_.result);
}

void VerdictWriter::choose_next() {
  Verdict& verdict = state_.result.verdict;
  if (verdict.outcome == Outcome::ambiguous) {
    state_.log.say("choosing the next experiment", 0.97);
    std::vector<Hypothesis> models;
    const bool is_partly = std::ranges::any_of(
        verdict.causes, [](const NamedCause& cause) { return !cause.instead_of.empty(); });
    const auto wait = [&](const NamedCause& cause) {
      // Of causes that act together only those that something would stand in for are to be told
      // apart.
      return is_partly && cause.instead_of.empty() &&
             std::ranges::find(verdict.causes, cause.name, &NamedCause::instead_of) ==
                 verdict.causes.end();
    };
    for (const NamedCause& cause : verdict.causes)
      if (!wait(cause) && std::ssize(models) < state_.settings().budget.competing_models)
        models.push_back(model_of(cause.name));
    state_.result.next = next_experiment(
        state_.experiment(), state_.setup->data(), models,
        {state_.result.numerics, state_.options.threads, state_.options.stop, state_.settings()},
        verdict.simulations);
  } else if (verdict.outcome == Outcome::unknown) {
    state_.result.next =
        next_look(state_.experiment(), state_.setup->data(), state_.result.predictions[refitted]);
  }
  verdict.next_experiment = state_.result.next.sentence;
}

// Refitted with a cause that the verdict lists: a candidate, or what may stand for a parameter.
Hypothesis VerdictWriter::model_of(const std::string& cause) const {
  const FitSummary* found = &state_.findings.needed.model;
  for (const Candidate& candidate : state_.result.ranking)
    if (candidate.cause == cause) found = &candidate.fit;
  // With what is certain beside it, where it is one of several.
  for (const Findings::Substitute& other : state_.findings.substitutes) {
    if (other.candidate.cause == cause) found = &other.candidate.fit;
    if (other.link < state_.findings.chain.size() &&
        state_.findings.chain[other.link].cause == cause)
      found = &state_.result.best;
  }
  for (const NeededParameters::Instead& other : state_.findings.needed.instead)
    if (other.model.hypothesis.name == cause) found = &other.model;
  Hypothesis model = found->hypothesis;
  model.name = cause;
  return model;
}

void VerdictWriter::predict() {
  const std::array<Hypothesis, model_count> models{Hypothesis{}, state_.result.base.hypothesis,
                                                   state_.result.best.hypothesis};
  auto all = state_.setup->predictions(models);
  for (int m = 0; m < model_count; ++m) state_.result.predictions[m] = std::move(all[m]);
}

}  // namespace pedicel::discrepancy
