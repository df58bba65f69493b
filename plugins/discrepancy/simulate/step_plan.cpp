#include "plugins/discrepancy/simulate/step_plan.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr double same_time = 1.0e-9;  // s

// How many steps from `step` on are taken as one, of those that begin at `begin` and are `length`
// (s) long. What follows must have room to get shorter again.
int taken_as_one(std::span<const TimeSpan> quiet, double begin, double length, int step, int count,
                 int before, int most) {
  const double t = begin + step * length;
  for (const TimeSpan& span : quiet) {
    if (t < span.begin - same_time || t >= span.end) continue;
    const int end =
        std::min(count, static_cast<int>(std::floor((span.end - begin + same_time) / length)));
    int taken = std::min(2 * before, most);
    while (taken > 1 && step + 2 * taken - 1 > end) taken /= 2;
    return taken;
  }
  return 1;
}

}  // namespace

StepPlan make_step_plan(std::span<const double> events, double dt, double end, double until,
                        std::span<const TimeSpan> quiet, int most) {
  std::vector<double> ends;
  for (const double event : events)
    if (event > same_time && event < end - same_time) ends.push_back(event);
  std::sort(ends.begin(), ends.end());
  ends.erase(
      std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < same_time; }),
      ends.end());
  const std::size_t jumps = ends.size();
  if (end > same_time) ends.push_back(end);
  if (std::isfinite(until) && until > end + same_time)
    ends.push_back(end + dt * std::ceil((until - end) / dt - same_time));
  StepPlan plan;
  plan.time.push_back(0.0);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double begin = plan.time.back();
    const int count = std::max(1, static_cast<int>(std::ceil((ends[i] - begin) / dt - 1.0e-6)));
    const double length = (ends[i] - begin) / count;
    for (int k = 0, taken = 1; k < count && plan.time.back() < until - same_time; k += taken) {
      taken = taken_as_one(quiet, begin, length, k, count, taken, most);
      plan.restart.push_back(k == 0 && i > 0 && i <= jumps ? 1 : 0);
      plan.dt.push_back(taken * length);
      plan.time.push_back(k + taken == count ? ends[i] : begin + (k + taken) * length);
    }
    if (plan.time.back() < ends[i]) break;
  }
  return plan;
}

}  // namespace pedicel::discrepancy
