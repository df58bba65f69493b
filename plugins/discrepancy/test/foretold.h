#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/simulate/data_set.h"

namespace pedicel::discrepancy {

/// How well a model foretells what an engineer would ask of a trial.
struct Foretold {
  enum class What { rest, frequency };
  int trial = 0;
  What what = What::rest;
  /// Measured over foretold less 1: of the way from the drawn shape to where it rests, or of the
  /// frequency of its free swing.
  double off = 0.0;
  double error = 0.0;  ///< of it, one standard error, from the noise alone
};

/// What counts as foretold: 5 %.
inline constexpr double well_foretold = 0.05;

/// Of every trial, in their order, where it rests at last and how fast it swings. What a trial does
/// not show is left out: one that never rests, or rests as it was drawn.
std::vector<Foretold> foretold(const Experiment& experiment, const DataSet& data,
                               const std::vector<Prediction>& predictions);

/// What the model misses beyond 5 % in these trials, and which effects would make that, as
/// sentences; that it misses nothing, where it does not. Empty where the trials show nothing.
std::string foretold_text(const Experiment& experiment, const std::vector<Foretold>& all,
                          const std::vector<int>& held_out);

}  // namespace pedicel::discrepancy
