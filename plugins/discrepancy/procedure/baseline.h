#pragma once

#include "plugins/discrepancy/procedure/model_check.h"

namespace pedicel::discrepancy {

/// Steps 0 to 2: noise, the refitted model, and whether anything is wrong with it.
class Baseline {
 public:
  /// Keeps references.
  Baseline(DiagnosisState& state, ModelCheck& check) : state_(state), check_(check) {}

  /// Reads the noise and lists the causes.
  void prepare();
  /// Refits modulus, density and damping, as far as the data see them.
  void refit_parameters();
  /// Raises the alarm.
  void look();
  /// The held-out trial that the refitted model misses most; -1: none.
  int objecting_trial();

 private:
  void refit_base();
  void refine();
  void judge_drive();
  bool is_masked(const NumericsCheck& check) const;

  DiagnosisState& state_;
  ModelCheck& check_;
};

}  // namespace pedicel::discrepancy
