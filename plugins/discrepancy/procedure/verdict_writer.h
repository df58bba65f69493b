#pragma once

#include <string>

#include "plugins/discrepancy/procedure/force_search.h"

namespace pedicel::discrepancy {

/// Steps 7 to 9: what is accepted, what it is worth, and what to do next.
class VerdictWriter {
 public:
  /// Keeps references.
  VerdictWriter(DiagnosisState& state, ModelCheck& check, ForceSearch& force)
      : state_(state), check_(check), force_(force) {}

  /// `instead_of`: why one force takes the place of the known causes, or empty. `objecting`: the
  /// held-out trial that speaks against the refitted model; -1: none.
  void write(const std::string& instead_of, int objecting);
  /// Where the search was cut short: what is known so far.
  void write_partial();

 private:
  void see_what_is_needed();
  void judge_named(const std::string& instead_of, int objecting);
  void ask_for_one_force();
  void tell_of_force();
  void judge_stalks();
  void choose_next();
  Hypothesis model_of(const std::string& cause) const;
  void predict();

  DiagnosisState& state_;
  ModelCheck& check_;
  ForceSearch& force_;
};

}  // namespace pedicel::discrepancy
