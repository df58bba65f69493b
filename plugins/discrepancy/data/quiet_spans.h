#pragma once

#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

struct TimeSpan {
  double begin = 0.0, end = 0.0;  ///< s
};

/// Standard deviations of what is measured, m, N and N m.
struct NoiseLevels {
  double position = 0.0, force = 0.0, moment = 0.0;
};

/// When nothing moves in a trial that its instruments could see, in order: over 0.4 s neither a
/// marker, a force nor what drives the plant leaves a straight line by more than its noise, and
/// that for 0.8 s at least. Empty where samples are too far apart to show a swing, where what
/// drives the plant turns, and where fruits come off.
std::vector<TimeSpan> quiet_spans(const Trial& trial, const NoiseLevels& noise);

}  // namespace pedicel::discrepancy
