#pragma once

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Adds the trials of `more`, which were done afterwards on the same plant with the same markers
/// (those of `more` may stand in another order, and some may be missing). Throws UsageError where
/// plant or markers differ, or a trial's name is there already.
void add_trials(const Experiment& more, Experiment& experiment);

}  // namespace pedicel::discrepancy
