#pragma once

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// A path without the noise of its rows, `std` (m) of each axis: the smoothest one, by its second
/// differences, that is off the rows by no more than that, rms (Whittaker, 1923). The orientation
/// stays as it is.
DrivenPath smoothed(const DrivenPath& path, double std);

/// An experiment whose paths are smoothed within StatedNoise::path_std, those of static series as
/// they are; nothing where that is not stated.
std::optional<Experiment> with_smooth_paths(const Experiment& experiment);

}  // namespace pedicel::discrepancy
