#include <algorithm>

#include "pedicel/discrepancy/data/sentence.h"
#include "pedicel/discrepancy/procedure/diagnosis_procedure.h"
#include "pedicel/discrepancy/select/evidence.h"
#include "pedicel/discrepancy/test/score_test.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// The base with the effects of `both` that stand behind those of `first`, from their numbers there.
Hypothesis without_first(const Hypothesis& base, const Hypothesis& first, const Hypothesis& both) {
  const int effects = static_cast<int>(first.effects.size());
  Hypothesis second;
  second.effects.assign(both.effects.begin() + effects, both.effects.end());
  second.free.assign(both.free.begin() + first.size(), both.free.end());
  for (FreeParameter& free : second.free) free.effect -= effects;
  Hypothesis alone = base;
  alone.set_unknowns(both.unknowns().head(base.size()));
  alone.add(second);
  alone.name = both.name;
  return alone;
}

// Whether the data tell how large the effects from `first` on are: to a factor of e, one
// deviation.
bool has_a_size(const FitSummary& model, int first) {
  for (int p = 0; p < model.hypothesis.size(); ++p) {
    const FreeParameter& free = model.hypothesis.free[p];
    const bool size = free.effect >= first && free.vanishes != Vanishes::never && free.prior <= 0.0;
    if (size && free.logarithmic && model.standard_error[p] > 1.0) return false;
  }
  return true;
}

}  // namespace

RefitOptions Procedure::refit_options(double from, double to, const std::string& what) {
  RefitOptions refit{fit_options(), result_.check_trials, {}, options_.stop};
  refit.progress = [this, from, to, what](double share) {
    log_.say(what, from + share * (to - from));
  };
  return refit;
}

void Procedure::search() {
  simulators_->renew_fine();
  result_.ranking = refit_all(simulators_->workers(), result_.base, causes_, result_.directions,
                              refit_options(0.2, 0.6, "refitting candidates"));
  if (stopped()) return;
  for (std::size_t i = 0; i < std::min<std::size_t>(6, result_.ranking.size()); ++i)
    if (result_.ranking[i].whole)
      log_.fit(text("Evidence %.5g", result_.ranking[i].evidence), result_.ranking[i].fit,
               setup_->samples());
  if (result_.ranking.empty() ||
      result_.ranking.front().evidence < options_.settings.levels.worth_naming)
    return;
  if (leaves_much(result_.ranking.front().fit) && one_force_does_more()) return;
  result_.best = result_.ranking.front().fit;
  findings_.chain = {result_.ranking.front()};
}

bool Procedure::leaves_much(const FitSummary& model) const {
  return 2.0 * model.cost > options_.settings.evidence.much_left * setup_->samples();
}

// More known causes would but imitate what none of them is, slowly.
bool Procedure::one_force_does_more() {
  const Candidate& best = result_.ranking.front();
  const double noise = 0.5 * setup_->samples();
  const double left = (best.fit.cost - noise) / std::max(1.0, result_.base.cost - noise);
  const std::string sentence = "the best known cause, " + best.cause +
                               text(", leaves %.2g %% of what is wrong", 100.0 * left);
  log_.note("One force is asked for: " + sentence + ".");
  const MissingForce& force = missing_force(0.6);
  if (!force.found || force.fit.why == "not run" ||
      1.0 - force.share > options_.settings.evidence.left_by_force * left)
    return false;
  instead_of_ = sentence;
  return true;
}

// Adds causes while something is left.
void Procedure::extend() {
  while (!findings_.chain.empty() &&
         static_cast<int>(findings_.chain.size()) < options_.settings.budget.causes && !stopped()) {
    const std::vector<Direction> directions = look_again();
    log_.directions(directions, result_.after);
    if (!result_.after.raised || is_small(result_.after)) return;
    if (explained_by_junctions(result_.after, result_.best)) {
      result_.after.raised = false;
      return;
    }
    const double from = 0.5 + 0.15 * static_cast<double>(findings_.chain.size());
    const std::vector<Cause> likely =
        screened(causes_, directions, options_.settings.budget.screened);
    const std::vector<Candidate> next =
        refit_all(simulators_->workers(), result_.best, likely, directions,
                  refit_options(from, from + 0.15, "looking for another cause"));
    if (stopped() || next.empty()) return;
    const Candidate& first = next.front();
    log_.fit(text("Beside what was found, evidence %.4g", first.evidence), first.fit,
             setup_->samples());
    log_.note(text("It gains %.4g nats, of %.4g that another cause must; ", first.gain,
                   least_gain_beside(findings_.chain, options_.settings)) +
              text("for the held-out trials %.4g.", first.held_out.gain));
    if (!is_another_cause(first)) return;
    if (eliminates_first(first)) continue;
    findings_.chain.push_back(first);
    result_.best = first.fit;
  }
  if (!findings_.chain.empty()) look_again();
}

void Procedure::correct_at(const FitSummary& model) {
  setup_->correct_at(model);
  if (setup_->numerics() == result_.numerics) return;
  result_.numerics = setup_->numerics();
  log_.note(text("Here nodes every %.3g mm and a step of %.3g ms", 1e3 * result_.numerics.distance,
                 1e3 * result_.numerics.dt) +
            " are needed.");
  simulators_->renew_fine();
}

// So that a model which explains them is far from it.
bool Procedure::base_misses_the_data() const {
  return 2.0 * result_.base.cost > options_.settings.evidence.far_from_data * setup_->samples();
}

// What the model with all causes so far leaves. Where that is far from the base, our own error
// is another one there.
std::vector<Direction> Procedure::look_again() {
  if (base_misses_the_data()) {
    correct_at(result_.best);
    Evaluator evaluator = setup_->evaluator();
    result_.best = findings_.chain.back().fit = refit(evaluator, result_.best, fit_options());
  }
  anchor_at(result_.best);
  std::vector<Direction> directions = directions_at(result_.best);
  result_.after = judged(directions, result_.best);
  return directions;
}

// Searches go by a cheaper simulator that agrees with the fine one at the model they extend.
void Procedure::anchor_at(const FitSummary& model) {
  simulators_->anchor_at(model);
  const CoarseModel& coarse = simulators_->coarse();
  log_.note(text("Searching with nodes every %.3g mm and a step of %.3g ms",
                 1e3 * coarse.numerics().distance, 1e3 * coarse.numerics().dt) +
            text(", carried along as a correction: %.2g of the noise.", coarse.error()));
}

std::vector<Direction> Procedure::directions_at(const FitSummary& model) {
  return simulators_->directions_of(model, causes_, result_.directions);
}

// Whether what is left alarms, but scores too little for another cause.
bool Procedure::is_small(const Alarm& alarm) const {
  const double predicted = 0.5 * alarm.statistic * alarm.statistic;  // were the model linear
  return !alarm.residual_power.shows() && options_.settings.evidence.beyond_linear * predicted <
                                              least_gain_beside(findings_.chain, options_.settings);
}

// The held-out trials may ask for what those fitted to hardly show: that is no finding.
bool Procedure::is_another_cause(const Candidate& next) const {
  if (next.evidence < options_.settings.levels.worth_naming ||
      next.gain < least_gain_beside(findings_.chain, options_.settings) ||
      !next.held_out.carries_over(options_.settings.evidence))
    return false;
  if (!has_a_size(next.fit, static_cast<int>(result_.best.hypothesis.effects.size()))) return false;
  return std::ranges::all_of(findings_.chain, [&](const Candidate& found) {
    return !effects::same_family(found.cause, next.cause) ||
           next.gain > options_.settings.evidence.family_share * found.gain;
  });
}

// What was found first may have stood in for this cause, whose own fit did not get so far from its
// starts; from where it stands beside the first one it does. Then the first one must bring as much
// beside it as any other cause, or is none.
bool Procedure::eliminates_first(const Candidate& next) {
  if (findings_.chain.size() != 1 || stopped()) return false;
  const auto known = std::ranges::find(result_.ranking, next.cause, &Candidate::cause);
  if (known == result_.ranking.end()) return false;
  const FitSummary& first = findings_.chain.front().fit;
  Evaluator evaluator = setup_->evaluator();
  Candidate alone = next;
  alone.fit =
      fit(evaluator, without_first(result_.base.hypothesis, first.hypothesis, next.fit.hypothesis),
          fit_options());
  const double dispersion = std::max(1.0, 2.0 * next.fit.cost / setup_->samples());
  alone.gain = (result_.base.cost - alone.fit.cost) / dispersion;
  const double brought = (alone.fit.cost - next.fit.cost) / dispersion;
  log_.note(findings_.chain.front().cause + " beside " + next.cause +
            text(" brings %.4g nats, of %.4g that another cause must.", brought,
                 least_gain_beside({alone}, options_.settings)));
  if (brought >= least_gain_beside({alone}, options_.settings)) return false;
  alone.held_out = held_out_by(alone.fit);
  alone.whole = alone.fine = true;
  std::vector<Candidate> ranking = result_.ranking;
  ranking[known - result_.ranking.begin()] = std::move(alone);
  weigh(ranking, result_.base, setup_->samples(),
        dispersion_of(ranking, result_.base, setup_->samples()), options_.settings);
  if (ranking.front().cause != next.cause) return false;
  result_.ranking = std::move(ranking);
  findings_.chain = {result_.ranking.front()};
  result_.best = findings_.chain.front().fit;
  return true;
}

}  // namespace pedicel::discrepancy
