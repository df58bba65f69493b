#include "plugins/discrepancy/procedure/diagnosis.h"

#include "engine/core/stop.h"
#include "plugins/discrepancy/data/trial_split.h"
#include "plugins/discrepancy/procedure/diagnosis_procedure.h"
#include "plugins/discrepancy/select/continuation.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

Diagnosis Procedure::run() {
  Verdict& verdict = state_.result.verdict;
  // Before anything is simulated: data that contradict themselves would be explained all the same,
  // by whatever cause bends enough.
  if (!state_.result.admission.refusal.empty()) {
    verdict.outcome = Outcome::bad_data;
    verdict.remainder = state_.result.admission.refusal;
    return finished();
  }
  try {
    search();
  } catch (const Stopped&) {
    // Building and settling a plant hear the signal, too.
    // Who did not ask for a part of the answer gets none.
    if (!state_.options.cut_short) throw;
  }
  if (state_.options.cut_short && state_.stopped()) {
    // From here on nothing is stopped any more. Without this every simulation of the conclusion
    // would end at once.
    deadline_.release();
    // The caller is told before the conclusion begins, which takes a while.
    state_.options.cut_short();
    verdict_.write_partial();
    // What is known is of this split of the trials. Another one would begin anew, and there is no
    // time.
    exchanged_.reset();
  }
  return finished();
}

void Procedure::search() {
  baseline_.prepare();
  // It may end the diagnosis: a drive that cannot be right, or our own error too large. Both leave
  // an outcome that is not `adequate`.
  baseline_.refit_parameters();
  if (state_.result.verdict.outcome == Outcome::adequate && !state_.stopped()) decide();
}

void Procedure::decide() {
  baseline_.look();
  // Or a refitted number is far from what is known of it: then it has taken up what is wrong, and
  // nothing is left for an alarm.
  const bool wrong = state_.result.before.raised ||
                     has_prior_shift(state_.result.base.hypothesis, state_.settings());
  // Only where nothing else is wrong: a wrong model misses held-out trials, too.
  // Order matters: causes that show in the fitted trials explain held-out ones, too, and are looked
  // for first.
  const int objecting = wrong || state_.stopped() ? -1 : baseline_.objecting_trial();
  // An effect in that trial alone is seen once the trial is fitted.
  if (objecting >= 0 && exchanges(objecting)) return;
  if (wrong) {
    causes_.search();
    causes_.extend();
  }
  // Stopped, the search has not come to its end, and run() writes what is known.
  if (!state_.stopped()) verdict_.write(causes_.instead_of(), objecting);
}

// Whether a trial can be fitted in place of another one. Then all begins anew: what was read of the
// noise and refitted so far did not know it.
bool Procedure::exchanges(int objecting) {
  Experiment other = state_.given;
  const TrialSplit split{state_.result.fit_trials, state_.result.check_trials};
  // Not where the experiment states what its trials are for: then the verdict says so.
  if (!exchange_trials(other, split, objecting)) return false;
  state_.log.note("It is fitted in place of another one, and all begins anew.");
  exchanged_ = std::move(other);
  state_.result.exchanged = state_.experiment().trials[objecting].name;
  return true;
}

Diagnosis Procedure::finished() {
  if (state_.setup) {
    state_.result.position_noise = state_.setup->data().position_noise();
    state_.result.force_noise = state_.setup->data().force_noise();
    state_.result.verdict.simulations += state_.setup->simulations();
  }
  if (state_.simulators) {
    state_.result.verdict.simulations += state_.simulators->simulations();
    // Their memory goes: the caller keeps the result for its report.
    state_.simulators->drop();
  }
  // A partial verdict is complete in its own way, and may be shown.
  state_.result.stopped = state_.stopped() && !state_.result.verdict.partial;
  state_.result.verdict.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return std::move(state_.result);
}

Diagnosis diagnose(const Experiment& experiment, const DiagnosisOptions& asked) {
  Deadline deadline(asked.stop, asked.time_limit);
  // The deadline's own flag in place of the caller's, so that time and a key are one thing to all
  // who ask.
  DiagnosisOptions options = asked;
  options.stop = deadline.flag();
  // Over both procedures, where all begins anew.
  options.progress = rising(asked.progress);
  Procedure first(experiment, options, deadline);
  Diagnosis found = first.run();
  if (!first.exchanged()) return found;
  // A procedure runs once: noise, corrections and simulators are those of its own trials. It cannot
  // exchange again, as the trial that objects is fitted now.
  Diagnosis again = Procedure(*first.exchanged(), options, deadline).run();
  again.exchanged = found.exchanged;
  again.steps.insert(again.steps.begin(), found.steps.begin(), found.steps.end());
  again.verdict.simulations += found.verdict.simulations;
  // What it cost is what both took.
  again.verdict.seconds += found.verdict.seconds;
  return again;
}

plant::PlantFile extended_plant(const Experiment& experiment, const Hypothesis& hypothesis) {
  plant::PlantFile plant = experiment.plant();
  for (const plant::Effect& effect : hypothesis.effects) {
    const effects::EffectDefinition* known = effects::find_effect(effect.name);
    // What is wrong with an instrument or a grip does not go into the plant.
    if (known && known->file == effects::EffectFile::plant) plant.effects.push_back(effect);
  }
  return plant;
}

}  // namespace pedicel::discrepancy
