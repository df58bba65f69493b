#include "plugins/discrepancy/procedure/diagnosis_state.h"

#include <algorithm>
#include <array>

#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

DiagnosisState::DiagnosisState(const Experiment& experiment, const DiagnosisOptions& with)
    : given(experiment), options(with), log(with.progress, with.note, result.steps) {
  result.settings = options.settings;
  findings.settings = &options.settings;
  log.settings(options.settings);
  // All that follows goes by the admitted experiment, where outliers are left out.
  result.admission = admit(experiment);
}

HeldOut DiagnosisState::held_out_by(const FitSummary& model) {
  if (result.check_trials.empty()) return {};
  Evaluator evaluator = setup->evaluator();
  FitOptions check = fit_options();
  check.trials = result.check_trials;
  const HeldOutModel base = held_out_model(evaluator, result.base, check);
  const std::array extended{held_out_model(evaluator, model, check)};
  const double dispersion = std::max(1.0, 2.0 * model.cost / setup->samples());
  return held_out(base, extended, setup->data().samples(check.trials), dispersion).front();
}

bool DiagnosisState::base_misses_the_data() const {
  return 2.0 * result.base.cost > settings().evidence.far_from_data * setup->samples();
}

void DiagnosisState::correct_at(const FitSummary& model) {
  setup->correct_at(model);
  // The same mesh and step: the fine simulators still hold.
  if (setup->numerics() == result.numerics) return;
  result.numerics = setup->numerics();
  log.note(text("Here nodes every %.3g mm and a step of %.3g ms", 1e3 * result.numerics.distance,
                1e3 * result.numerics.dt) +
           " are needed.");
  simulators->renew_fine();
}

}  // namespace pedicel::discrepancy
