#pragma once

#include <span>

#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/select/decoys.h"

namespace pedicel::discrepancy {

/// What a model gains (nats) over another one by its own change, and what the same change would
/// gain backwards in time, or at each marker's neighbour, over these trials. Wrenches and torques
/// have no neighbours: they are left out of the latter. `too_alike`: as decoys_of()'s.
Decoys scene_decoys(const Experiment& experiment, const SceneDataSet& data,
                    std::span<const int> trials, std::span<const SceneReadings> without,
                    std::span<const SceneReadings> with, double too_alike);

}  // namespace pedicel::discrepancy
