#include "pedicel/discrepancy/simulate/step_plan.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {
constexpr double same_time = 1.0e-9;  // s
}

StepPlan make_step_plan(std::span<const double> events, double dt, double end, double until) {
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
    for (int k = 1; k <= count && plan.time.back() < until - same_time; ++k) {
      plan.restart.push_back(k == 1 && i > 0 && i <= jumps ? 1 : 0);
      plan.dt.push_back(length);
      plan.time.push_back(k == count ? ends[i] : begin + k * length);
    }
    if (plan.time.back() < ends[i]) break;
  }
  return plan;
}

}  // namespace pedicel::discrepancy
