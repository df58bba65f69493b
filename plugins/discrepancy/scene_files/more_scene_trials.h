#pragma once

#include "plugins/discrepancy/scene/scene_experiment.h"

namespace pedicel::discrepancy {

/// Adds the trials of `more`, which were done afterwards in the same place: the same robot, plants
/// drawn alike, and instruments of the same names (those of `more` may stand in another order, and
/// some may be missing). The model stays that of `experiment`: what the scene of `more` says of
/// materials, contact and effects is not looked at. Throws UsageError where robot, plants or
/// instruments differ, or a trial's name is there already.
void add_trials(const SceneExperiment& more, SceneExperiment& experiment);

}  // namespace pedicel::discrepancy
