#include "plugins/discrepancy/procedure/cause_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/discrepancy/select/symptom_starts.h"
#include "plugins/discrepancy/test/score_test.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// At most so many competitors of a cause are fitted in its place: each takes a fit.
constexpr std::size_t most_competitors = 2;

// The effects of `both` that stand behind those of `first`, from their numbers there.
Hypothesis behind_first(const Hypothesis& first, const Hypothesis& both) {
  const int effects = static_cast<int>(first.effects.size());
  Hypothesis second;
  second.effects.assign(both.effects.begin() + effects, both.effects.end());
  second.free.assign(both.free.begin() + first.size(), both.free.end());
  for (FreeParameter& free : second.free) free.effect -= effects;
  return second;
}

// The base with the effects of `both` that stand behind those of `first`. Its numbers begin beside
// the first cause and not at the cause's own starts, because only there the data have told what is
// left for it.
Hypothesis without_first(const Hypothesis& base, const Hypothesis& first, const Hypothesis& both) {
  Hypothesis alone = base;
  alone.set_unknowns(both.unknowns().head(base.size()));
  alone.add(behind_first(first, both));
  alone.name = both.name;
  return alone;
}

// Whether the data tell how large the effects from `first` on are: to a factor of e, one
// deviation.
bool has_a_size(const FitSummary& model, int first) {
  for (int p = 0; p < model.hypothesis.size(); ++p) {
    const FreeParameter& free = model.hypothesis.free[p];
    const bool size = free.effect >= first && free.vanishes != Vanishes::never && free.prior <= 0.0;
    // A logarithm that is open by one is a factor of e. What has no size of its own follows
    // whatever is left.
    if (size && free.logarithmic && model.standard_error[p] > 1.0) return false;
  }
  return true;
}

}  // namespace

RefitOptions CauseSearch::refit_options(double from, double to, const std::string& what) {
  RefitOptions refit{state_.fit_options(),
                     state_.result.check_trials,
                     {},
                     state_.options.stop,
                     state_.options.parts};
  refit.progress = [this, from, to, what](double share) {
    // Shares of the whole diagnosis: each stage fills its part of one bar.
    state_.log.say(what, from + share * (to - from));
  };
  return refit;
}

// The symptoms of a model, in the trials that are fitted, lead the causes on top of it.
void CauseSearch::lead_by_symptoms(const FitSummary& model, std::vector<Cause>& causes) {
  std::vector<Prediction> predicted =
      state_.setup->predictions(std::span(&model.hypothesis, 1)).front();
  // Those held out are to judge what is found, so nothing starts from them.
  for (const int t : state_.result.check_trials) predicted[t].healthy = false;
  const Experiment& experiment = state_.experiment();
  const std::string led = lead(causes, symptoms(experiment, state_.setup->data(), predicted),
                               start_context(experiment, scales_of(experiment)));
  if (!led.empty()) state_.log.note("Symptoms say where to start: " + led + ".");
}

void CauseSearch::search() {
  lead_by_symptoms(state_.result.base, state_.causes);
  // At the mesh, the step and with the corrections that the baseline ended with.
  state_.simulators->renew_fine();
  state_.result.ranking =
      refit_all(state_.simulators->workers(), state_.result.base, state_.causes,
                state_.result.directions, refit_options(0.12, 0.72, "refitting candidates"));
  if (state_.stopped()) return;
  for (std::size_t i = 0; i < std::min<std::size_t>(6, state_.result.ranking.size()); ++i)
    if (state_.result.ranking[i].whole)
      state_.log.fit(text("Evidence %.5g", state_.result.ranking[i].evidence),
                     state_.result.ranking[i].fit, state_.setup->samples());
  // Below that no cause is worth a name. The ranking stays, for the report.
  if (state_.result.ranking.empty() ||
      state_.result.ranking.front().evidence < state_.settings().levels.worth_naming)
    return;
  // Asked for before more causes are added: three that imitate a force take long and explain
  // nothing.
  if (leaves_much(state_.result.ranking.front().fit) && one_force_does_more()) return;
  state_.result.best = state_.result.ranking.front().fit;
  state_.findings.chain = {state_.result.ranking.front()};
}

bool CauseSearch::leaves_much(const FitSummary& model) const {
  return 2.0 * model.cost > state_.settings().evidence.much_left * state_.setup->samples();
}

// More known causes would but imitate what none of them is, slowly.
bool CauseSearch::one_force_does_more() {
  const Candidate& best = state_.result.ranking.front();
  const double noise = 0.5 * state_.setup->samples();
  // Of what can be explained: noise is left by every model.
  const double left = (best.fit.cost - noise) / std::max(1.0, state_.result.base.cost - noise);
  const std::string sentence = "the best known cause, " + best.cause +
                               text(", leaves %.2g %% of what is wrong", 100.0 * left);
  state_.log.note("One force is asked for: " + sentence + ".");
  const MissingForce& force = force_.find(0.72);
  // One force must leave a third of what the best cause leaves. A free course over time follows
  // much of anything.
  if (!force.found || force.fit.why == "not run" ||
      1.0 - force.share > state_.settings().evidence.left_by_force * left)
    return false;
  instead_of_ = sentence;
  return true;
}

void CauseSearch::extend() {
  add_causes();
  substitute_first();
}

// While something is left.
void CauseSearch::add_causes() {
  while (!state_.findings.chain.empty() &&
         static_cast<int>(state_.findings.chain.size()) < state_.settings().budget.causes &&
         !state_.stopped()) {
    const std::vector<Direction> directions = look_again();
    state_.log.directions(directions, state_.result.after);
    // An alarm whose strongest direction could not bring what a further cause must is not worth a
    // dozen refits.
    if (!state_.result.after.raised || check_.leaves_little(state_.result.after)) return;
    if (check_.explained_by_junctions(state_.result.after, state_.result.best)) {
      state_.result.after.raised = false;
      return;
    }
    state_.simulators->renew_fine();
    const double from = 0.62 + 0.1 * static_cast<double>(state_.findings.chain.size());
    // The most significant directions alone: each candidate takes a fit.
    std::vector<Cause> likely =
        screened(state_.causes, directions, state_.settings().budget.screened);
    lead_by_symptoms(state_.result.best, likely);
    const std::vector<Candidate> next =
        refit_all(state_.simulators->workers(), state_.result.best, likely, directions,
                  refit_options(from, from + 0.1, "looking for another cause"));
    if (state_.stopped() || next.empty()) return;
    const Candidate& first = next.front();
    state_.log.fit(text("Beside what was found, evidence %.4g", first.evidence), first.fit,
                   state_.setup->samples());
    state_.log.note(text("It gains %.4g nats, of %.4g that another cause must; ", first.gain,
                         least_gain_beside(state_.findings.chain, state_.settings())) +
                    text("for the held-out trials %.4g.", first.held_out.gain));
    if (!is_worth_more(first)) return;
    // The chain begins anew with this one; what it leaves is looked at again. Asked before the
    // families: a cause stands in for one of its own family most easily.
    if (eliminates_first(first)) continue;
    if (!is_of_another_kind(first)) return;
    remember_competitors(next);
    state_.findings.chain.push_back(first);
    state_.result.best = first.fit;
  }
  // The last one added was not looked at yet, and the verdict needs what is left.
  if (!state_.findings.chain.empty()) look_again();
}

// Those that came as near beside the chain as the one that is added to it.
void CauseSearch::remember_competitors(const std::vector<Candidate>& next) {
  const Candidate& added = next.front();
  const double margin = margin_over(added, state_.settings());
  for (std::size_t i = 1; i < next.size() && i <= most_competitors; ++i) {
    const double behind = added.evidence - next[i].evidence;
    // Sorted: whole fits first, by evidence.
    if (!next[i].whole) break;
    state_.log.note(next[i].cause + " in place of " + added.cause +
                    text(" would lose by %.4g nats, of %.4g that it must.", behind, margin));
    if (behind > margin) break;
    state_.findings.substitutes.push_back({state_.findings.chain.size(), next[i], behind});
  }
}

// Whatever came near the first cause alone is fitted beside the others, too: only there it can be
// compared.
void CauseSearch::substitute_first() {
  std::vector<Candidate>& chain = state_.findings.chain;
  if (chain.size() < 2 || state_.stopped()) return;
  const Candidate& first = chain.front();
  const double margin = margin_over(first, state_.settings());
  // Alone it had to stand in for the others as well, and so had its competitors: they count from
  // farther behind.
  const double reach = state_.settings().evidence.most_margins * margin;
  const FitSummary best = state_.result.best;
  const double dispersion = std::max(1.0, 2.0 * best.cost / state_.setup->samples());
  const double own = cost_of_numbers(best, dispersion) - state_.held_out_by(best).gain;
  const Hypothesis others = behind_first(first.fit.hypothesis, best.hypothesis);
  std::size_t tried = 0;
  for (const Candidate& competitor : state_.result.ranking) {
    if (competitor.cause == first.cause) continue;
    if (!competitor.whole || first.evidence - competitor.evidence > reach ||
        tried == most_competitors)
      break;
    const bool found = std::ranges::any_of(
        chain, [&](const Candidate& named) { return named.cause == competitor.cause; });
    if (found || state_.stopped()) continue;
    ++tried;
    Hypothesis instead = competitor.fit.hypothesis;
    instead.add(others);
    Evaluator evaluator = state_.setup->evaluator();
    Candidate candidate = competitor;
    candidate.fit = fit(evaluator, instead, state_.fit_options());
    const double numbers =
        cost_of_numbers(candidate.fit, dispersion) - state_.held_out_by(candidate.fit).gain;
    const double behind = (candidate.fit.cost - best.cost) / dispersion + numbers - own;
    state_.log.note(
        competitor.cause + " in place of " + first.cause +
        text(" beside the others loses by %.4g nats, of %.4g that it must.", behind, margin));
    state_.findings.substitutes.push_back({0, std::move(candidate), behind});
  }
  put_best_first();
}

// Where a competitor does better beside the others than the first cause does, it takes its place.
void CauseSearch::put_best_first() {
  std::vector<Candidate>& chain = state_.findings.chain;
  std::vector<Findings::Substitute>& all = state_.findings.substitutes;
  const auto of_first = [](const Findings::Substitute& one) { return one.link == 0; };
  const auto best = std::ranges::min_element(all, {}, [&](const Findings::Substitute& one) {
    return of_first(one) ? one.behind : std::numeric_limits<double>::infinity();
  });
  if (best == all.end() || !of_first(*best) || best->behind >= 0.0) return;
  const double ahead = -best->behind;
  const auto alone =
      std::ranges::find(state_.result.ranking, best->candidate.cause, &Candidate::cause);
  for (Findings::Substitute& one : all)
    if (of_first(one)) one.behind += ahead;
  Candidate displaced = chain.front();
  displaced.fit = std::exchange(state_.result.best, best->candidate.fit);
  chain.back().fit = state_.result.best;
  chain.front() = *alone;
  best->candidate = std::move(displaced);
  best->behind = ahead;
  state_.log.note(chain.front().cause + " takes the place of " + best->candidate.cause + ".");
}

// What the model with all causes so far leaves. Where that is far from the base, our own error
// is another one there.
std::vector<Direction> CauseSearch::look_again() {
  if (state_.base_misses_the_data()) {
    state_.correct_at(state_.result.best);
    Evaluator evaluator = state_.setup->evaluator();
    // Refitted, because the correction moved with the model: the fits before and after are to the
    // same predictions.
    state_.result.best = state_.findings.chain.back().fit =
        refit(evaluator, state_.result.best, state_.fit_options());
  }
  // What the search kept in memory is not needed for a look.
  state_.simulators->drop_fine();
  check_.anchor_at(state_.result.best);
  std::vector<Direction> directions = check_.directions_at(state_.result.best);
  state_.result.after = check_.judged(directions, state_.result.best);
  return directions;
}

// The held-out trials may ask for what those fitted to hardly show: that is no finding.
// Each of the four is a way in which a second cause was found that was not there: too little
// evidence, less than solvers differ by, nothing on held-out trials, and no size.
bool CauseSearch::is_worth_more(const Candidate& next) const {
  return next.evidence >= state_.settings().levels.worth_naming &&
         next.gain >= least_gain_beside(state_.findings.chain, state_.settings()) &&
         next.held_out.carries_over(state_.settings().evidence) &&
         has_a_size(next.fit, static_cast<int>(state_.result.best.hypothesis.effects.size()));
}

// Beside a cause of its own family, only what brings much is another one: the rest is what two
// implementations of one law differ by.
bool CauseSearch::is_of_another_kind(const Candidate& next) const {
  return std::ranges::all_of(state_.findings.chain, [&](const Candidate& found) {
    return !effects::same_family(found.cause, next.cause) ||
           next.gain > state_.settings().evidence.family_share * found.gain;
  });
}

// What was found first may have stood in for this cause, whose own fit did not get so far from its
// starts; from where it stands beside the first one it does. Then the first one must bring as much
// beside it as any other cause, or is none.
bool CauseSearch::eliminates_first(const Candidate& next) {
  // Of three causes any two might stand in for the third. Only the first one was found without the
  // others.
  if (state_.findings.chain.size() != 1 || state_.stopped()) return false;
  const auto known = std::ranges::find(state_.result.ranking, next.cause, &Candidate::cause);
  // Not tried alone in the first round, so there is no place for it in the order.
  if (known == state_.result.ranking.end()) return false;
  const FitSummary& first = state_.findings.chain.front().fit;
  Evaluator evaluator = state_.setup->evaluator();
  Candidate alone = next;
  alone.fit =
      fit(evaluator,
          without_first(state_.result.base.hypothesis, first.hypothesis, next.fit.hypothesis),
          state_.fit_options());
  // By what both together leave, the best that is known: so the two gains are in one unit.
  const double dispersion = std::max(1.0, 2.0 * next.fit.cost / state_.setup->samples());
  alone.gain = (state_.result.base.cost - alone.fit.cost) / dispersion;
  const double brought = (alone.fit.cost - next.fit.cost) / dispersion;
  state_.log.note(state_.findings.chain.front().cause + " beside " + next.cause +
                  text(" brings %.4g nats, of %.4g that another cause must.", brought,
                       least_gain_beside({alone}, state_.settings())));
  if (brought >= least_gain_beside({alone}, state_.settings())) return false;
  alone.held_out = state_.held_out_by(alone.fit);
  // Fitted with the fine simulator, to its end.
  alone.whole = alone.fine = true;
  std::vector<Candidate> ranking = state_.result.ranking;
  ranking[known - state_.result.ranking.begin()] = std::move(alone);
  // All again, as the new fit changes the least cost, and with it the unit of all gains.
  weigh(ranking, state_.result.base, state_.setup->samples(),
        dispersion_of(ranking, state_.result.base, state_.setup->samples()), state_.settings());
  if (ranking.front().cause != next.cause) return false;
  state_.result.ranking = std::move(ranking);
  state_.findings.chain = {state_.result.ranking.front()};
  state_.findings.substitutes.clear();
  state_.result.best = state_.findings.chain.front().fit;
  return true;
}

}  // namespace pedicel::discrepancy
