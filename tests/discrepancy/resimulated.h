#pragma once

#include <cstdint>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"
#include "tests/discrepancy/reference_trial.h"

namespace pedicel::hidden {

struct MeasuringOptions {
  std::uint64_t seed = 1;    ///< of the noise
  double rho = 0.0;          ///< of the markers' noise, from sample to sample
  double mesh = 0.25;        ///< longest segment, as a share of the plant's `distance`
  double dt = 0.0017;        ///< s, longest step
  bool follow_plant = true;  ///< holds start where the plant stands with what is hidden in it
};

/// The trials of an experiment done again by the reference simulator, on its plant with `effects`
/// and `outside` hidden in it: same drives, same sample times, noise as the experiment states it.
/// Throws std::invalid_argument where samples do not come at equal intervals from 0 on, and for
/// plants that the reference does not know.
discrepancy::Experiment resimulated(discrepancy::Experiment experiment,
                                    const std::vector<plant::Effect>& effects,
                                    const std::vector<reference::OutsideEffect>& outside,
                                    const MeasuringOptions& options);

}  // namespace pedicel::hidden
