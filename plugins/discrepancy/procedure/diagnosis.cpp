#include "pedicel/discrepancy/procedure/diagnosis.h"

#include "pedicel/core/stop.h"
#include "pedicel/discrepancy/data/trial_split.h"
#include "pedicel/discrepancy/procedure/diagnosis_procedure.h"
#include "pedicel/discrepancy/select/continuation.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

Diagnosis Procedure::run() {
  Verdict& verdict = state_.result.verdict;
  if (!state_.result.admission.refusal.empty()) {
    verdict.outcome = Outcome::bad_data;
    verdict.remainder = state_.result.admission.refusal;
    return finished();
  }
  try {
    search();
  } catch (const Stopped&) {
    // Building and settling a plant hear the signal, too.
    if (!state_.options.cut_short) throw;
  }
  if (state_.options.cut_short && state_.stopped()) {
    deadline_.release();
    state_.options.cut_short();
    verdict_.write_partial();
    exchanged_.reset();
  }
  return finished();
}

void Procedure::search() {
  baseline_.prepare();
  baseline_.refit_parameters();
  if (state_.result.verdict.outcome == Outcome::adequate && !state_.stopped()) decide();
}

void Procedure::decide() {
  baseline_.look();
  const bool wrong = state_.result.before.raised ||
                     has_prior_shift(state_.result.base.hypothesis, state_.settings());
  // Only where nothing else is wrong: a wrong model misses held-out trials, too.
  const int objecting = wrong || state_.stopped() ? -1 : baseline_.objecting_trial();
  // An effect in that trial alone is seen once the trial is fitted.
  if (objecting >= 0 && exchanges(objecting)) return;
  if (wrong) {
    causes_.search();
    causes_.extend();
  }
  if (!state_.stopped()) verdict_.write(causes_.instead_of(), objecting);
}

// Whether a trial can be fitted in place of another one. Then all begins anew: what was read of the
// noise and refitted so far did not know it.
bool Procedure::exchanges(int objecting) {
  Experiment other = state_.given;
  const TrialSplit split{state_.result.fit_trials, state_.result.check_trials};
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
    state_.simulators->drop();
  }
  state_.result.stopped = state_.stopped() && !state_.result.verdict.partial;
  state_.result.verdict.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return std::move(state_.result);
}

Diagnosis diagnose(const Experiment& experiment, const DiagnosisOptions& asked) {
  Deadline deadline(asked.stop, asked.time_limit);
  DiagnosisOptions options = asked;
  options.stop = deadline.flag();
  Procedure first(experiment, options, deadline);
  Diagnosis found = first.run();
  if (!first.exchanged()) return found;
  Diagnosis again = Procedure(*first.exchanged(), options, deadline).run();
  again.exchanged = found.exchanged;
  again.steps.insert(again.steps.begin(), found.steps.begin(), found.steps.end());
  again.verdict.simulations += found.verdict.simulations;
  again.verdict.seconds += found.verdict.seconds;
  return again;
}

plant::PlantFile extended_plant(const Experiment& experiment, const Hypothesis& hypothesis) {
  plant::PlantFile plant = experiment.plant;
  for (const plant::Effect& effect : hypothesis.effects) {
    const effects::EffectDefinition* known = effects::find_effect(effect.name);
    if (known && known->file == effects::EffectFile::plant) plant.effects.push_back(effect);
  }
  return plant;
}

}  // namespace pedicel::discrepancy
