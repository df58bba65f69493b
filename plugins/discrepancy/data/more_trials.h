#pragma once

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Adds the trials of `more`, which were done afterwards in the same place: with the same plant
/// file, or the same robot and plants drawn alike, and with instruments of the same names (those of
/// `more` may stand in another order, and some may be missing). The model stays that of
/// `experiment`: what a scene of `more` says of materials, contact and effects is not looked at.
/// Throws UsageError where robot, plants or instruments differ, or a trial's name is there already.
void add_trials(const Experiment& more, Experiment& experiment);

}  // namespace pedicel::discrepancy
