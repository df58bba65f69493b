#pragma once

#include <span>
#include <vector>

#include "plugins/discrepancy/data/quiet_spans.h"

namespace pedicel::discrepancy {

/// When a trial's steps begin and end. Steps are equal between two events and not longer than asked
/// for, so that every event falls on the end of one. Where nothing moves some are taken as one.
struct StepPlan {
  std::vector<double> time;  ///< s, 0 first, one more than there are steps
  std::vector<double> dt;    ///< s, of each step
  /// 1 where forces jump as the step begins: it is of first order, because BDF2 would take the
  /// velocity's bend for curvature and be of first order for good.
  std::vector<char> restart;

  int steps() const { return static_cast<int>(dt.size()); }
  bool operator==(const StepPlan&) const = default;
};

/// `events`: times of jumps, in any order, those outside (0, end) left out. Goes on with equal
/// steps from `end` to `until` where that is later, and stops with the first step that reaches
/// `until` where that is sooner: the steps before it are the same for every `until`. Within a span
/// of `quiet` a step is as long as up to `most` others. Neighbours differ by a factor of two at
/// most, up to which BDF2 is of second order.
StepPlan make_step_plan(std::span<const double> events, double dt, double end, double until,
                        std::span<const TimeSpan> quiet = {}, int most = 1);

}  // namespace pedicel::discrepancy
