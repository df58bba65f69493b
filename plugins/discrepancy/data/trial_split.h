#pragma once

#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Which trials are fitted and which are held out for checking: as the experiment says; where it
/// says nothing, whole trials are held out, one of every three, of the kinds that occur more than
/// once first, so that each kind of test is still fitted. A single trial is fitted.
struct TrialSplit {
  std::vector<int> fit, check;
};
TrialSplit split_trials(const Experiment& experiment);

/// States another split: the held-out trial `objecting` is fitted, and in its place the last of
/// the fitted ones, of its kind if there is one, is held out. False where the experiment itself
/// states what a trial is for, or none is left to hold out: nothing is changed.
bool exchange_trials(Experiment& experiment, const TrialSplit& split, int objecting);

}  // namespace pedicel::discrepancy
