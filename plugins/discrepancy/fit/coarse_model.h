#pragma once

#include <memory>
#include <vector>

#include "plugins/discrepancy/fit/fit_setup.h"

namespace pedicel::discrepancy {

/// A cheaper simulator that agrees with the fine one at one model: nodes twice as far apart and
/// steps twice as long where that is allowed, its difference there from the fine one's corrected
/// predictions carried as a correction of every prediction. Searches use it; what they find is
/// refitted with the fine one. (An additive correction anchored at the current model: Alexandrov
/// and Lewis, Optimization and Engineering 2, 2001, their "first-order" condition for values only.)
class CoarseModel {
 public:
  /// `anchor` has been fitted with `setup`, which must outlive this.
  CoarseModel(FitSetup& setup, const FitSummary& anchor);

  /// On all threads.
  Evaluator evaluator();
  /// One for each thread.
  std::vector<Evaluator> workers();
  const Numerics& numerics() const { return numerics_; }
  /// RMS in units of the noise, of what is carried as a correction but for a shift of the
  /// parameters.
  double error() const { return error_; }
  long simulations() const;

 private:
  void anchor_at(const FitSummary& model, const Numerics& numerics);

  FitSetup& setup_;
  Numerics numerics_;
  Corrections corrections_;
  double error_ = 0.0;
  std::unique_ptr<Simulator> simulator_;
  std::vector<std::unique_ptr<Simulator>> single_;  // of one thread each
};

}  // namespace pedicel::discrepancy
