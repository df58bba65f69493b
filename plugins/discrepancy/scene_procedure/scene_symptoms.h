#pragma once

#include <span>
#include <vector>

#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/settings/scene_settings.h"

namespace pedicel::discrepancy {

/// In which respects measured trials differ from predictions, one a trial: when the tool touches
/// and lets go, how much the contact rubs, how far the arm's log lags, how the camera's image has
/// moved, what the wrench says at rest, and where the plant stands. The clearest of each kind
/// first.
std::vector<SymptomNumber> scene_symptoms(const Experiment& experiment, const SceneDataSet& data,
                                          std::span<const SceneReadings> predicted,
                                          const SceneSymptomSettings& settings);

}  // namespace pedicel::discrepancy
