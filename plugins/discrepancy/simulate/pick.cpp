#include "pedicel/discrepancy/simulate/pick.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pedicel::discrepancy {

namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vec3 zero_of(const Samples& force, double rest) {
  Vec3 zero = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (int i = 0; i < force.size(); ++i)
      if (force.time[i] < force.time.front() + rest && std::isfinite(force.value(i, axis)))
        values.push_back(force.value(i, axis));
    zero[axis] = median(values);
  }
  return zero;
}

// From the peak to the first crossing of half of it, straight between two samples.
double time_to_half(const std::vector<double>& time, const std::vector<double>& size,
                    std::size_t peak) {
  const double half = 0.5 * size[peak];
  for (std::size_t i = peak + 1; i < size.size(); ++i) {
    if (size[i] > half) continue;
    const double share = (size[i - 1] - half) / (size[i - 1] - size[i]);
    return time[i - 1] + share * (time[i] - time[i - 1]) - time[peak];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Pick judge_pick(const Samples& force, const PickSettings& settings) {
  Pick pick;
  pick.time_to_half = std::numeric_limits<double>::quiet_NaN();
  if (force.size() == 0) return pick;
  const Vec3 zero = zero_of(force, settings.rest);
  std::vector<double> time, size;
  for (int i = 0; i < force.size(); ++i) {
    const Vec3 net = force.value.row(i).head<3>().transpose() - zero;
    if (!net.allFinite()) continue;
    time.push_back(force.time[i]);
    size.push_back(net.norm());
  }
  if (size.empty()) return pick;
  const auto peak =
      static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  pick.peak_force = size[peak];
  pick.peak_time = time[peak];
  pick.time_to_half = time_to_half(time, size, peak);
  if (pick.peak_force < settings.least_peak || !std::isfinite(pick.time_to_half)) return pick;
  pick.end = pick.time_to_half <= settings.slowest ? Pick::End::detached : Pick::End::slipped;
  return pick;
}

}  // namespace pedicel::discrepancy
