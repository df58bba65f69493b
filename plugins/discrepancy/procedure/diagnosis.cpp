#include "pedicel/discrepancy/procedure/diagnosis.h"

#include "pedicel/discrepancy/data/trial_split.h"
#include "pedicel/discrepancy/procedure/diagnosis_procedure.h"
#include "pedicel/discrepancy/select/continuation.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

Procedure::Procedure(const Experiment& experiment, const DiagnosisOptions& options)
    : given_(experiment),
      options_(options),
      start_(std::chrono::steady_clock::now()),
      log_(options.progress, options.note, result_.steps) {
  result_.settings = options.settings;
  findings_.settings = &options_.settings;
  log_.settings(options.settings);
  result_.admission = admit(experiment);
}

Diagnosis Procedure::run() {
  if (result_.admission.refusal.empty()) {
    prepare();
    fit_baseline();
    if (result_.verdict.outcome != Outcome::numerical && !stopped()) decide();
  } else {
    result_.verdict.outcome = Outcome::bad_data;
    result_.verdict.remainder = result_.admission.refusal;
  }
  return finished();
}

void Procedure::decide() {
  look();
  const bool wrong =
      result_.before.raised || has_prior_shift(result_.base.hypothesis, options_.settings);
  if (!wrong && !stopped()) look_at_check_trials();
  if (objecting_ >= 0) {
    Experiment other = given_;
    const TrialSplit split{result_.fit_trials, result_.check_trials};
    if (exchange_trials(other, split, objecting_)) {
      log_.note("It is fitted in place of another one, and all begins anew.");
      exchanged_ = std::move(other);
      result_.exchanged = experiment().trials[objecting_].name;
      return;
    }
  }
  if (wrong) {
    search();
    extend();
  }
  if (!stopped()) conclude_all();
}

Diagnosis Procedure::finished() {
  if (setup_) {
    result_.position_noise = setup_->data().position_noise();
    result_.force_noise = setup_->data().force_noise();
    result_.verdict.simulations += setup_->simulations();
  }
  if (simulators_) {
    result_.verdict.simulations += simulators_->simulations();
    simulators_->drop();
  }
  result_.stopped = stopped();
  result_.verdict.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return std::move(result_);
}

Diagnosis diagnose(const Experiment& experiment, const DiagnosisOptions& options) {
  Procedure first(experiment, options);
  Diagnosis found = first.run();
  if (!first.exchanged()) return found;
  Diagnosis again = Procedure(*first.exchanged(), options).run();
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
