#include "plugins/discrepancy/procedure/model_check.h"

#include <algorithm>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/select/evidence.h"

namespace pedicel::discrepancy {

// Searches go by a cheaper simulator that agrees with the fine one at the model they extend.
void ModelCheck::anchor_at(const FitSummary& model) {
  state_.simulators->anchor_at(model);
  const CoarseModel& coarse = state_.simulators->coarse();
  state_.log.note(text("Searching with nodes every %.3g mm and a step of %.3g ms",
                       1e3 * coarse.numerics().distance, 1e3 * coarse.numerics().dt) +
                  text(", carried along as a correction: %.2g of the noise.", coarse.error()));
}

std::vector<Direction> ModelCheck::directions_at(const FitSummary& model) {
  return state_.simulators->directions_of(model, state_.causes, state_.result.directions);
}

// The directed tests, and what they do not look for.
Alarm ModelCheck::judged(std::vector<Direction>& directions, const FitSummary& model) const {
  if (state_.stopped()) return {};
  Alarm alarm = judge(directions, model, state_.numerical, state_.options.seed, state_.settings());
  // The directed tests see known causes best; this one sees what none of them is.
  alarm.residual_power = residual_power(state_.setup->data(), state_.fit_options().trials, model,
                                        state_.numerical, state_.settings());
  alarm.raised = alarm.raised || alarm.residual_power.shows();
  return alarm;
}

bool ModelCheck::explained_by_junctions(const Alarm& before, FitSummary& model) {
  // More than this no mesh explains.
  if (!before.raised || before.statistic > state_.settings().levels.beyond_mesh) return false;
  const Hypothesis junctions = junction_nuisance(state_.experiment(), state_.settings().evidence);
  if (junctions.size() == 0) return false;
  Hypothesis with = model.hypothesis;
  with.add(junctions);
  Evaluator evaluator = state_.setup->evaluator();
  FitOptions few = state_.fit_options();
  // A rough fit tells whether the junctions take it; if not, it was for nothing.
  few.iterations = std::min(state_.settings().budget.junction_iterations, few.iterations);
  FitSummary found = fit(evaluator, with, few);
  CoarseModel coarse(*state_.setup, found);
  Evaluator there = coarse.evaluator();
  std::vector<Direction> directions =
      directions_of(there, found, state_.causes, state_.fit_options(), state_.result.directions);
  state_.result.verdict.simulations += coarse.simulations();
  const Alarm alarm = judged(directions, found);
  state_.log.fit("With junctions that give a little", found, state_.setup->samples());
  state_.log.directions(directions, alarm);
  if (alarm.raised || !is_discretisation(found, junctions.size(), state_.settings().evidence))
    return false;
  state_.log.note("What is left is below what the plant file's mesh resolves at the junctions.");
  model = std::move(found);
  return true;
}

bool ModelCheck::leaves_little(const Alarm& alarm) const {
  const double predicted = 0.5 * alarm.statistic * alarm.statistic;  // were the model linear
  return !alarm.residual_power.shows() &&
         state_.settings().evidence.beyond_linear * predicted <
             least_gain_beside(state_.findings.chain, state_.settings());
}

}  // namespace pedicel::discrepancy
