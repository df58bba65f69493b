#pragma once

#include "discrepancy/fit.h"

namespace pedicel::discrepancy {

/// How well our own numbers hold: what half the step and half the mesh would change.
struct NumericsCheck {
  Numerics numerics;
  /// Of step and mesh, whose errors are of second order: 4/3 of the differences (Richardson).
  Corrections corrections;
  /// Whitened: the correction of the chosen trials, less what the free parameters can absorb.
  Eigen::VectorXd correction;
  double largest = 0.0;                 ///< RMS of it in units of the noise
  double by_step = 0.0, by_mesh = 0.0;  ///< RMS of its two parts
  Eigen::VectorXd parameter_shift;      ///< of the unknowns, that the correction makes
};

/// Of our own error, and of the data's own, what a correction by Richardson may leave.
inline constexpr double left_uncorrected = 0.1;

/// Simulates the fitted model with half the step and with half the mesh.
NumericsCheck check_numerics(const Experiment& experiment, const DataSet& data,
                             const FitSummary& base, const Numerics& numerics,
                             const FitOptions& options, int threads, long& simulations,
                             const std::atomic<bool>* stop = nullptr);

/// The next finer numerics by what weighs more.
Numerics refined(const NumericsCheck& check);

}  // namespace pedicel::discrepancy
