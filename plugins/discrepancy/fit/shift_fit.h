#pragma once

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

using Predictions = std::vector<Prediction>;  ///< one a trial of the experiment

/// sum += share (to - from), of a sum that may still be empty.
void add_difference(Predictions& sum, double share, const Predictions& to, const Predictions& from);

/// All trials of the experiment with a model and each of these shifts, without corrections.
std::vector<Predictions> run_shifted(Simulator& simulator, const Hypothesis& model,
                                     std::span<const Shift> shifts);

/// What a change of all predictions amounts to as a shift of modulus, density and damping time
/// about one model.
class ShiftFit {
 public:
  /// Keeps the references. `own` is the shift that the model has there already.
  ShiftFit(Simulator& simulator, const DataSet& data, const Hypothesis& model, const Shift& own,
           const FitOptions& options);

  /// The model's predictions, shifted by `own` alone.
  const Predictions& now() const { return now_; }
  /// Whitened, of the chosen trials.
  Eigen::VectorXd change(const Predictions& to, const Predictions& from) const;
  /// The shift that explains most of that change, held small where the data hardly see it.
  Shift stands_for(const Predictions& to, const Predictions& from) const;

 private:
  const DataSet& data_;
  const FitOptions& options_;
  Predictions now_;
  Eigen::MatrixXd by_parameter_;  // whitened change by each logarithm
};

}  // namespace pedicel::discrepancy
