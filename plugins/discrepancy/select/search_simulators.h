#pragma once

#include <memory>
#include <vector>

#include "plugins/discrepancy/fit/coarse_model.h"
#include "plugins/discrepancy/select/candidates.h"

namespace pedicel::discrepancy {

/// What a search for causes simulates with: cheap simulators that agree with the fine one at the
/// model that is extended, and fine ones for what may win; of both kinds one a thread, because
/// candidates are refitted side by side.
class SearchSimulators {
 public:
  /// Keeps a reference to `setup`.
  explicit SearchSimulators(FitSetup& setup) : setup_(setup) {}

  /// The cheap ones anew, about this model.
  void anchor_at(const FitSummary& model);
  /// The fine ones anew, at the mesh, the step and with the corrections of the setup.
  void renew_fine();
  void drop();
  void drop_fine();

  /// Those of both kinds, which must have been made.
  Workers workers() { return {coarse_workers_, fine_workers_}; }
  /// What every cause would change about `model`, by the cheap simulator, which has its anchor
  /// there.
  std::vector<Direction> directions_of(const FitSummary& model, const std::vector<Cause>& causes,
                                       const std::vector<Direction>& known);
  const CoarseModel& coarse() const { return *coarse_; }
  /// All so far.
  long simulations() const;

 private:
  void drop_coarse();

  FitSetup& setup_;
  std::unique_ptr<CoarseModel> coarse_;
  std::vector<std::unique_ptr<Simulator>> fine_;
  std::vector<Evaluator> coarse_workers_, fine_workers_;
  long simulations_ = 0;  // of simulators that are gone
};

}  // namespace pedicel::discrepancy
