#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy::testing {

/// One push of a cane at one height: the part of the record above a fifth of its range of force,
/// both axes from where a straight line through it begins.
struct CanePush {
  int bush = 0, branch = 0, trial = 0;
  double height = 0.0, diameter = 0.0;  ///< m, of the place that was pushed
  std::vector<double> force;            ///< N
  std::vector<double> displacement;     ///< m
  double stiffness = 0.0;               ///< N/m, of the straight line
};

/// All pushes but the three that are known to be faulty (one never touched the cane, two slipped),
/// in the order of bush, branch and height (from the top). Throws InvalidFile.
std::vector<CanePush> read_cane_pushes(const std::filesystem::path& folder);

/// The pushes of one cane as an experiment: an upright cantilever from the ground to the highest
/// place, of the diameters measured (straight between them, the lowest one's below), that stands at
/// rest under a known force at time 0, three forces a height, each a trial with one sample. Only
/// the displacement along the push (x) was measured. Weight is left out: it was there before the
/// push.
Experiment cane_experiment(const std::vector<CanePush>& pushes);

}  // namespace pedicel::discrepancy::testing
