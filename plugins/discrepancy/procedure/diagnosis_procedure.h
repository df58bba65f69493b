#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/discrepancy/fit/fit_setup.h"
#include "pedicel/discrepancy/procedure/diagnosis.h"
#include "pedicel/discrepancy/procedure/diagnosis_log.h"
#include "pedicel/discrepancy/select/findings.h"
#include "pedicel/discrepancy/select/search_simulators.h"

namespace pedicel::discrepancy {

/// One diagnosis on its way from the data to the verdict; inside of diagnose() alone.
class Procedure {
 public:
  /// Keeps a reference to the experiment.
  Procedure(const Experiment& experiment, const DiagnosisOptions& options);

  /// Once.
  Diagnosis run();

  /// With another trial held out, where the diagnosis should begin anew.
  const std::optional<Experiment>& exchanged() const { return exchanged_; }

 private:
  const Experiment& experiment() const { return result_.admission.experiment; }
  const FitOptions& fit_options() const { return setup_->options(); }
  bool stopped() const { return options_.stop && *options_.stop; }
  void decide();
  Diagnosis finished();

  // Steps 0 to 2 (diagnosis_baseline.cpp).
  void prepare();
  void fit_baseline();
  void refit_base();
  void refine();
  bool is_masked(const NumericsCheck& check) const;
  void look();
  void look_at_check_trials();
  Alarm judged(std::vector<Direction>& directions, const FitSummary& model) const;
  bool explained_by_junctions(const Alarm& alarm, FitSummary& model);

  // Steps 4 to 7 (diagnosis_search.cpp).
  void search();
  bool one_force_does_more();
  void extend();
  std::vector<Direction> look_again();
  RefitOptions refit_options(double from, double to, const std::string& what);
  bool leaves_much(const FitSummary& model) const;
  bool base_misses_the_data() const;
  void correct_at(const FitSummary& model);
  void anchor_at(const FitSummary& model);
  std::vector<Direction> directions_at(const FitSummary& model);
  bool is_small(const Alarm& alarm) const;
  bool is_another_cause(const Candidate& next) const;
  bool eliminates_first(const Candidate& next);

  // Steps 8 and 9 (diagnosis_verdict.cpp).
  void conclude_all();
  HeldOut held_out_by(const FitSummary& model);
  void ask_for_one_force();
  const MissingForce& missing_force(double from, double least_evidence = 0.0);
  void tell_of_force();
  void judge_stalks();
  void choose_next();
  Hypothesis model_of(const std::string& cause) const;
  void predict();

  const Experiment& given_;
  DiagnosisOptions options_;
  std::chrono::steady_clock::time_point start_;
  Diagnosis result_;
  DiagnosisLog log_;
  std::unique_ptr<FitSetup> setup_;
  std::unique_ptr<SearchSimulators> simulators_;
  std::vector<Cause> causes_;
  Eigen::VectorXd numerical_;  // what our own error may leave in the residual
  Findings findings_;
  std::optional<MissingForce> force_;  // once it was asked for
  std::string instead_of_;             // the known cause whose place it takes, in words
  int objecting_ = -1;                 // the held-out trial that the refitted model misses most
  std::optional<Experiment> exchanged_;
};

}  // namespace pedicel::discrepancy
