#pragma once

#include <memory>
#include <vector>

#include "plugins/discrepancy/fit/fit_setup.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/procedure/diagnosis_log.h"
#include "plugins/discrepancy/select/findings.h"
#include "plugins/discrepancy/select/search_simulators.h"

namespace pedicel::discrepancy {

/// What one diagnosis has got so far, for the parts of the procedure, which run one after the
/// other.
struct DiagnosisState {
  /// Keeps a reference to the experiment, and admits it.
  DiagnosisState(const Experiment& experiment, const DiagnosisOptions& options);
  DiagnosisState(const DiagnosisState&) = delete;
  DiagnosisState& operator=(const DiagnosisState&) = delete;

  /// As it was admitted: what cannot be used is out.
  const Experiment& experiment() const { return result.admission.experiment; }
  const FitOptions& fit_options() const { return setup->options(); }
  const DiagnosisSettings& settings() const { return options.settings; }
  bool stopped() const { return options.stop && *options.stop; }

  /// What a model does for the held-out trials, against the base.
  HeldOut held_out_by(const FitSummary& model);
  /// Whether a model that explains the data is far from the base.
  bool base_misses_the_data() const;
  /// Mesh, step and corrections for our own error anew, at this model.
  void correct_at(const FitSummary& model);

  const Experiment& given;
  DiagnosisOptions options;
  Diagnosis result;
  DiagnosisLog log;
  std::unique_ptr<FitSetup> setup;               ///< from the baseline on
  std::unique_ptr<SearchSimulators> simulators;  ///< from the baseline on
  std::vector<Cause> causes;
  Eigen::VectorXd numerical;  ///< what our own error may leave in the residual
  Findings findings;
};

}  // namespace pedicel::discrepancy
