#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/admission/contradiction.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// What was wrong with the data before any physics, and the data without it.
struct Admission {
  Experiment experiment;  ///< wrong samples taken out, swapped labels put back
  int samples = 0, stuck = 0, filled = 0, swaps = 0, missing = 0;
  int points = 0,
      outliers = 0;  ///< a marker's place or a force at one time, far from its neighbours
  std::vector<std::string> remarks;  ///< one sentence each
  std::string refusal;               ///< why the data cannot be used; empty: they can
  /// What the refusal is about; empty where it is about all of them.
  std::vector<Contradiction> contradictions;

  double outlier_fraction() const {
    return points > 0 ? static_cast<double>(outliers) / points : 0.0;
  }
};

/// Looks for single outlying points (far from the cubic through their neighbours, against the
/// scatter around them), channels that stand still to the last digit, gaps that were filled by
/// lines, labels that two markers exchange, trials without data, and what the data contradict
/// (contradiction.h).
Admission admit(const Experiment& experiment);

/// Why the data cannot be used, as errors of their files.
void add_refusal(Diagnostics& diagnostics, const Admission& admission);

}  // namespace pedicel::discrepancy
