#pragma once

#include <span>

#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"

namespace pedicel::discrepancy {

/// Adds to the data's noise what predictions of a model do not know of themselves: how far they are
/// from each other with other noise of the encoders. `finer`: predictions of the same model with a
/// finer mesh, one a trial; empty: none.
void widen_noise(SceneSimulator& simulator, SceneDataSet& data, const SceneVariant& model,
                 std::span<const SceneReadings> finer = {});

/// Predictions of all trials.
std::vector<SceneReadings> predictions_of(SceneSimulator& simulator, const SceneVariant& model);

}  // namespace pedicel::discrepancy
