#include <algorithm>
#include <array>
#include <cmath>

#include "pedicel/discrepancy/data/sentence.h"
#include "pedicel/discrepancy/fit/baseline_start.h"
#include "pedicel/discrepancy/procedure/diagnosis_procedure.h"

namespace pedicel::discrepancy {

void Procedure::prepare() {
  log_.say("reading the noise", 0.0);
  for (const std::string& remark : result_.admission.remarks) log_.note(remark + ".");
  // A marker that stands still scatters less than one that moves: what is stated is a lower
  // bound, too.
  setup_ = std::make_unique<FitSetup>(experiment(), options_.threads, NoiseRule{}, options_.stop,
                                      options_.settings);
  simulators_ = std::make_unique<SearchSimulators>(*setup_);
  findings_.data = &setup_->data();
  findings_.fit_trials = result_.fit_trials = fit_options().trials;
  result_.check_trials = setup_->check_trials();
  causes_ = candidate_causes(experiment(), scales_of(experiment()));
}

void Procedure::refit_base() {
  Evaluator evaluator = setup_->evaluator();
  result_.base = fit(evaluator, result_.base.hypothesis, fit_options());
}

void Procedure::fit_baseline() {
  log_.say("refitting modulus, density and damping", 0.02);
  Evaluator evaluator = setup_->evaluator();
  const Hypothesis start = baseline_start(evaluator, fit_options(), result_.unseen);
  const std::array horizons{options_.settings.budget.baseline_horizon, 1.0};
  log_.noise(setup_->data());
  result_.base = fit_growing(evaluator, start, fit_options(), horizons);
  log_.fit("Baseline", result_.base, setup_->samples());
  if (stopped()) return;
  refine();
  if (stopped()) return;
  setup_->renew_noise(result_.base.hypothesis);
  Evaluator again = setup_->evaluator();
  if (add_plainly_seen(again, fit_options(), result_.unseen, result_.base.hypothesis)) {
    log_.note("With the noise as it is read now these data see more of the parameters.");
    refit_base();
    setup_->renew_noise(result_.base.hypothesis);
  }
  refit_base();
  log_.noise(setup_->data());
  log_.fit("Baseline", result_.base, setup_->samples());
}

void Procedure::refine() {
  const NumericsCheck check = setup_->refine(
      result_.base,
      {[this](int round) { log_.say("checking our own numerical error", 0.05 + 0.03 * round); },
       [this](const NumericsCheck& coarse) {
         log_.note(
             text("Numerical error %.3g by step, %.3g by mesh", coarse.by_step, coarse.by_mesh));
       }});
  result_.numerics = setup_->numerics();
  result_.numerical_error = check.largest;
  numerical_ = options_.settings.accuracy.left_uncorrected * check.correction;
  findings_.parameter_shift = check.parameter_shift;
  if (check.largest > options_.settings.accuracy.numerical_limit && !is_masked(check)) {
    result_.verdict.outcome = Outcome::numerical;
    result_.verdict.remainder =
        text("half the step and half the mesh still move the prediction by %.2g times the noise",
             check.largest);
  }
  log_.note(text("Nodes every %.3g mm and a step of %.3g ms", 1e3 * result_.numerics.distance,
                 1e3 * result_.numerics.dt) +
            text(": the numerical error was %.2g of the noise and was corrected for.",
                 result_.numerical_error));
  setup_->renew();
  result_.base.hypothesis.add(mesh_nuisance());
  refit_base();
}

// Against a residual many times larger a numerical error above the noise does not matter.
bool Procedure::is_masked(const NumericsCheck& check) const {
  const double rms = std::sqrt(2.0 * result_.base.cost / std::max(1, setup_->samples()));
  return check.largest < options_.settings.accuracy.masked_verdict * rms;
}

void Procedure::look() {
  log_.say("looking for anything that is wrong", 0.15);
  anchor_at(result_.base);
  result_.directions = directions_at(result_.base);
  if (stopped()) return;
  result_.before = judged(result_.directions, result_.base);
  if (explained_by_junctions(result_.before, result_.base)) {
    // The base has more numbers now; a search for what pulled it starts from there.
    anchor_at(result_.base);
    result_.directions = directions_at(result_.base);
    result_.before = judged(result_.directions, result_.base);
    result_.before.raised = false;
  }
  result_.best = result_.base;
  log_.directions(result_.directions, result_.before);
}

// What acts in a held-out trial alone is not seen in those that are fitted.
void Procedure::look_at_check_trials() {
  Evaluator evaluator = setup_->evaluator();
  const double dispersion = std::max(1.0, 2.0 * result_.base.cost / setup_->samples());
  double most = 0.0;
  for (const int t : result_.check_trials) {
    FitOptions check = fit_options();
    check.trials = {t};
    const int samples = setup_->data().samples(check.trials);
    const double excess =
        held_out_excess(held_out_model(evaluator, result_.base, check), samples, dispersion) - 1.0;
    const double deviations = excess / std::sqrt(2.0 / std::max(1, samples));
    log_.note("What is left of trial " + experiment().trials[t].name +
              text(", held out, is %.3g deviations above the noise.", deviations));
    if (deviations < options_.settings.levels.held_out_deviations ||
        excess < options_.settings.levels.held_out_excess || excess < most)
      continue;
    most = excess;
    objecting_ = t;
  }
}

// The directed tests, and what they do not look for.
Alarm Procedure::judged(std::vector<Direction>& directions, const FitSummary& model) const {
  if (stopped()) return {};
  Alarm alarm = judge(directions, model, numerical_, options_.seed, options_.settings);
  alarm.residual_power =
      residual_power(setup_->data(), fit_options().trials, model, numerical_, options_.settings);
  alarm.raised = alarm.raised || alarm.residual_power.shows();
  return alarm;
}

// Whether nothing is left once the junctions may give a little; then they do.
bool Procedure::explained_by_junctions(const Alarm& before, FitSummary& model) {
  if (!before.raised || before.statistic > options_.settings.levels.beyond_mesh) return false;
  const Hypothesis junctions = junction_nuisance(experiment(), options_.settings.evidence);
  if (junctions.size() == 0) return false;
  Hypothesis with = model.hypothesis;
  with.add(junctions);
  Evaluator evaluator = setup_->evaluator();
  FitOptions few = fit_options();
  few.iterations = std::min(options_.settings.budget.junction_iterations, few.iterations);
  FitSummary found = fit(evaluator, with, few);
  CoarseModel coarse(*setup_, found);
  Evaluator there = coarse.evaluator();
  std::vector<Direction> directions =
      directions_of(there, found, causes_, fit_options(), result_.directions);
  result_.verdict.simulations += coarse.simulations();
  const Alarm alarm = judged(directions, found);
  log_.fit("With junctions that give a little", found, setup_->samples());
  log_.directions(directions, alarm);
  if (alarm.raised || !is_discretisation(found, junctions.size(), options_.settings.evidence))
    return false;
  log_.note("What is left is below what the plant file's mesh resolves at the junctions.");
  model = std::move(found);
  return true;
}

}  // namespace pedicel::discrepancy
