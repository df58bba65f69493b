#pragma once

#include <span>
#include <vector>

namespace pedicel::discrepancy {

/// When a trial's steps begin and end. Steps are equal between two events and not longer than asked
/// for, so that every event falls on the end of one.
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
/// `until` where that is sooner: the steps before it are the same for every `until`.
StepPlan make_step_plan(std::span<const double> events, double dt, double end, double until);

}  // namespace pedicel::discrepancy
