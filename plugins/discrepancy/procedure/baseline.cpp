#include "plugins/discrepancy/procedure/baseline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/fit/baseline_start.h"

namespace pedicel::discrepancy {

void Baseline::prepare() {
  state_.log.say("reading the noise", 0.0);
  // Admission ran before, when the state was made: what it left out is out of all that follows.
  for (const std::string& remark : state_.result.admission.remarks) state_.log.note(remark + ".");
  // A marker that stands still scatters less than one that moves: what is stated is a lower
  // bound, too.
  state_.setup = std::make_unique<FitSetup>(state_.experiment(), state_.options.threads,
                                            NoiseRule{}, state_.options.stop, state_.settings());
  // Empty still. Simulators are made for the mesh and the step that the baseline ends with.
  state_.simulators = std::make_unique<SearchSimulators>(*state_.setup);
  state_.findings.data = &state_.setup->data();
  state_.findings.fit_trials = state_.result.fit_trials = state_.fit_options().trials;
  state_.result.check_trials = state_.setup->check_trials();
  // Of the data alone, before any fit: what is tried must not depend on what was found.
  state_.causes = candidate_causes(state_.experiment(), scales_of(state_.experiment()));
}

void Baseline::refit_base() {
  Evaluator evaluator = state_.setup->evaluator();
  state_.result.base = fit(evaluator, state_.result.base.hypothesis, state_.fit_options());
}

void Baseline::refit_parameters() {
  state_.log.say("refitting modulus, density and damping", 0.01);
  Evaluator evaluator = state_.setup->evaluator();
  // Only what the data see is free. A density that nothing tells would wander off, and take the
  // modulus along.
  const Hypothesis start = baseline_start(evaluator, state_.fit_options(), state_.result.unseen);
  // Short first: over a whole record a wrong frequency is out of phase, and a fit stays there.
  const std::array horizons{state_.settings().budget.baseline_horizon, 1.0};
  state_.log.noise(state_.setup->data());
  state_.result.base = fit_growing(evaluator, start, state_.fit_options(), horizons);
  state_.log.fit("Baseline", state_.result.base, state_.setup->samples());
  if (state_.stopped()) return;
  // Noise is read from what a good model leaves, so mesh and step come first.
  refine();
  if (state_.stopped()) return;
  // From what the refitted model leaves. Read from the file's model, its errors would be taken for
  // noise, and hide what is looked for.
  state_.setup->renew_noise(state_.result.base.hypothesis);
  Evaluator again = state_.setup->evaluator();
  // Fewer were free as long as the noise was read from a worse model.
  // Once and not until nothing changes: the noise that is read with more numbers is hardly another
  // one.
  if (add_plainly_seen(again, state_.fit_options(), state_.result.unseen,
                       state_.result.base.hypothesis)) {
    state_.log.note("With the noise as it is read now these data see more of the parameters.");
    refit_base();
    state_.setup->renew_noise(state_.result.base.hypothesis);
  }
  refit_base();
  state_.log.noise(state_.setup->data());
  state_.log.fit("Baseline", state_.result.base, state_.setup->samples());
  // Last, because a modulus that is off by ten makes forces that are off by ten, and is mended by
  // the refit.
  judge_drive();
}

namespace {

// N, over the samples where a force was measured.
double force_rms(const Eigen::MatrixXd& force, const Eigen::MatrixXd& measured) {
  double squares = 0.0, count = 0.0;
  for (Eigen::Index i = 0; i < measured.size(); ++i)
    if (std::isfinite(measured(i)) && std::isfinite(force(i))) {
      squares += force(i) * force(i);
      count += 1.0;
    }
  return std::sqrt(squares / std::max(1.0, count));
}

}  // namespace

// A path that is off by its place or its unit stretches the plant in place of bending it, which
// takes forces that no cause explains. A modulus that is far off alone is mended by the refit.
void Baseline::judge_drive() {
  const Experiment& experiment = state_.experiment();
  const auto predicted = state_.setup->predictions(
      std::array<Hypothesis, 2>{Hypothesis{}, state_.result.base.hypothesis});
  const Levels& levels = state_.settings().levels;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const Trial& trial = experiment.trials[t];
    const Eigen::MatrixXd& measured = trial.force.value;
    const Eigen::MatrixXd &given = predicted[0][t].force, &fitted = predicted[1][t].force;
    if (measured.rows() == 0 || given.rows() != measured.rows() || fitted.rows() != measured.rows())
      continue;
    // Of a force that was hardly there the noise stands for it: a ratio to nothing would refuse
    // every path.
    const double was =
        std::max(force_rms(measured, measured), state_.setup->data().force_noise().std);
    const double needs = force_rms(given, measured);
    // Both must be impossible. As the file says it may be a wrong modulus, and after the refit it
    // would be a fit that went wrong.
    if (needs < levels.impossible_force * was ||
        force_rms(fitted, measured) < levels.impossible_refit * was)
      continue;
    state_.result.verdict.outcome = Outcome::bad_data;
    state_.result.verdict.remainder =
        "the drive of " + named_trial(trial.name) + " cannot be right: the model needs " +
        text("%.3g N at the hold where %.3g N were measured (RMS), ", needs, was) +
        text("and %.3g N when it is refitted; ", force_rms(fitted, measured)) +
        "check the path's place, unit and frame, and the unit of the force";
    return;
  }
}

void Baseline::refine() {
  // At the refitted model: how much a mesh errs depends on how the plant moves.
  const NumericsCheck check = state_.setup->refine(
      state_.result.base,
      {[this](int round) {
         state_.log.say("checking our own numerical error", 0.02 + 0.01 * round);
       },
       [this](const NumericsCheck& coarse) {
         state_.log.note(
             text("Numerical error %.3g by step, %.3g by mesh", coarse.by_step, coarse.by_mesh));
       }});
  state_.result.numerics = state_.setup->numerics();
  state_.result.numerical_error = check.largest;
  // A correction is itself uncertain: a share of it may be left.
  // Score tests take it off what they find: a direction that looks like our own error needs that
  // much more.
  state_.numerical = state_.settings().accuracy.left_uncorrected * check.correction;
  state_.findings.parameter_shift = check.parameter_shift;
  if (check.largest > state_.settings().accuracy.numerical_limit && !is_masked(check)) {
    state_.result.verdict.outcome = Outcome::numerical;
    state_.result.verdict.remainder =
        text("with nodes every %.3g mm and a step of %.3g ms, ",
             1e3 * state_.result.numerics.distance, 1e3 * state_.result.numerics.dt) +
        text("half the step and half the mesh still move the prediction by %.2g times the noise",
             check.largest);
  }
  state_.log.note(text("Nodes every %.3g mm and a step of %.3g ms",
                       1e3 * state_.result.numerics.distance, 1e3 * state_.result.numerics.dt) +
                  text(": the numerical error was %.2g of the noise and was corrected for.",
                       state_.result.numerical_error));
  // New evaluators, since the mesh, the step and the corrections are others now.
  state_.setup->renew();
  // What the mesh alone could explain must not become a cause.
  state_.result.base.hypothesis.add(mesh_nuisance());
  refit_base();
}

// Against a residual many times larger a numerical error above the noise does not matter.
// Else precise data and a poor model would ask for a very fine mesh, to say what anyone sees.
bool Baseline::is_masked(const NumericsCheck& check) const {
  const double rms =
      std::sqrt(2.0 * state_.result.base.cost / std::max(1, state_.setup->samples()));
  return check.largest < state_.settings().accuracy.masked_verdict * rms;
}

void Baseline::look() {
  state_.log.say("looking for anything that is wrong", 0.06);
  check_.anchor_at(state_.result.base);
  state_.result.directions = check_.directions_at(state_.result.base);
  if (state_.stopped()) return;
  state_.result.before = check_.judged(state_.result.directions, state_.result.base);
  if (check_.explained_by_junctions(state_.result.before, state_.result.base)) {
    // The base has more numbers now; a search for what pulled it starts from there.
    check_.anchor_at(state_.result.base);
    state_.result.directions = check_.directions_at(state_.result.base);
    state_.result.before = check_.judged(state_.result.directions, state_.result.base);
    // Junctions explain it. The numbers stay, so that what a cause would add is measured beside
    // them.
    state_.result.before.raised = false;
  }
  // Until a cause is found, refitted and extended are one model.
  state_.result.best = state_.result.base;
  state_.log.directions(state_.result.directions, state_.result.before);
}

// What acts in a held-out trial alone is not seen in those that are fitted.
int Baseline::objecting_trial() {
  Evaluator evaluator = state_.setup->evaluator();
  // What the model leaves everywhere is no reason to blame one trial.
  const double dispersion = std::max(1.0, 2.0 * state_.result.base.cost / state_.setup->samples());
  double most = 0.0;
  int objecting = -1;
  for (const int t : state_.result.check_trials) {
    FitOptions check = state_.fit_options();
    // One by one: what acts in one trial is thinned out among all.
    check.trials = {t};
    const int samples = state_.setup->data().samples(check.trials);
    const double excess =
        held_out_excess(held_out_model(evaluator, state_.result.base, check), samples, dispersion) -
        1.0;
    // The mean square of n normal residuals has the variance 2 / n.
    const double deviations = excess / std::sqrt(2.0 / std::max(1, samples));
    state_.log.note("What is left of trial " + state_.experiment().trials[t].name +
                    text(", held out, is %.3g deviations above the noise.", deviations));
    // As deviations and as an excess: in a long record next to nothing is significant, and in a
    // short one much is chance.
    if (deviations < state_.settings().levels.held_out_deviations ||
        excess < state_.settings().levels.held_out_excess || excess < most)
      continue;
    most = excess;
    objecting = t;
  }
  return objecting;
}

}  // namespace pedicel::discrepancy
