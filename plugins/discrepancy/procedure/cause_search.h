#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/procedure/force_search.h"

namespace pedicel::discrepancy {

/// Steps 4 to 6: causes are refitted, and added one after the other while something is left.
class CauseSearch {
 public:
  /// Keeps references.
  CauseSearch(DiagnosisState& state, ModelCheck& check, ForceSearch& force)
      : state_(state), check_(check), force_(force) {}

  /// The first cause.
  void search();
  /// Those beside it.
  void extend();
  /// Where one force takes the place of the best known cause: why, in words. Else empty.
  const std::string& instead_of() const { return instead_of_; }

 private:
  void add_causes();
  bool one_force_does_more();
  std::vector<Direction> look_again();
  void lead_by_symptoms(const FitSummary& model, std::vector<Cause>& causes);
  RefitOptions refit_options(double from, double to, const std::string& what);
  bool leaves_much(const FitSummary& model) const;
  bool is_worth_more(const Candidate& next) const;
  bool is_of_another_kind(const Candidate& next) const;
  bool eliminates_first(const Candidate& next);
  void remember_competitors(const std::vector<Candidate>& next);
  void substitute_first();
  void put_best_first();

  DiagnosisState& state_;
  ModelCheck& check_;
  ForceSearch& force_;
  std::string instead_of_;
};

}  // namespace pedicel::discrepancy
