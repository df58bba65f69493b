#pragma once

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// How well our own numbers hold: what half the step and half the mesh would change.
struct NumericsCheck {
  Numerics numerics;
  /// Of step and mesh, whose errors are of second order: 4/3 of the differences (Richardson). A
  /// mesh coarser than the plant file's is not yet of that order near junctions: all of what the
  /// file's changes, and 4/3 of what half of that changes.
  Corrections corrections;
  /// Whitened: the correction of the chosen trials, less what the free parameters can take up.
  Eigen::VectorXd correction;
  double largest = 0.0;                 ///< RMS of it in units of the noise
  double by_step = 0.0, by_mesh = 0.0;  ///< RMS of its two parts
  Eigen::VectorXd parameter_shift;      ///< of the unknowns, that the correction makes
};

/// Simulates the fitted model with half the step and with half the mesh (of the plant file's, where
/// the model's is coarser).
NumericsCheck check_numerics(const Experiment& experiment, const DataSet& data,
                             const FitSummary& base, const Numerics& numerics,
                             const FitOptions& options, int threads, long& simulations,
                             const std::atomic<bool>* stop = nullptr);

/// The next finer numerics by what weighs more.
Numerics refined(const NumericsCheck& check);

}  // namespace pedicel::discrepancy
