#include "plugins/discrepancy/data/trial_clock.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr double least_motion = 0.02;  // of a path's whole way, from where it begins

double median_step(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

class Collector {
 public:
  void at(double time) {
    if (!std::isfinite(time)) return;
    times_.first = times_.any ? std::min(times_.first, time) : time;
    times_.last = times_.any ? std::max(times_.last, time) : time;
    times_.any = true;
  }

  // From the first to the last row between which it moves, and no later than `until`.
  void path(const DrivenPath& path, double until) {
    double way = 0.0;
    for (const Vec3& x : path.position) way = std::max(way, (x - path.position.front()).norm());
    if (way == 0.0) return;
    const double least = least_motion * way;
    const std::vector<Vec3>& x = path.position;
    std::size_t begin = 0, end = x.size() - 1;
    while (begin + 1 < x.size() && (x[begin + 1] - x.front()).norm() < least) ++begin;
    while (end > begin && (x[end - 1] - x.back()).norm() < least) --end;
    if (path.time[begin] < until) at(path.time[begin]);
    if (path.time[begin] < until) at(std::min(path.time[end], until));
  }

  DriveTimes times_;
};

}  // namespace

TableClock clock_of(const std::filesystem::path& file, const std::vector<double>& time) {
  if (time.empty()) return {file, 0.0, 0.0, 0.0, 0};
  return {file, time.front(), time.back(), median_step(time), static_cast<int>(time.size())};
}

std::vector<TableClock> clocks_of(const Trial& trial) {
  std::vector<TableClock> clocks;
  const auto add = [&](const std::filesystem::path& file, const std::vector<double>& time) {
    if (!time.empty()) clocks.push_back(clock_of(file, time));
  };
  add("markers.csv", trial.markers.time);
  add("force.csv", trial.force.time);
  add(trial.wrench_file, trial.wrench.time);
  for (const Hold& hold : trial.holds) add(hold.path.file, hold.path.time);
  if (trial.base) add(trial.base->file, trial.base->time);
  return clocks;
}

DriveTimes drive_times(const Trial& trial) {
  Collector collector;
  bool lasts = false;
  for (const Hold& hold : trial.holds) {
    collector.path(hold.path, hold.release);
    collector.at(hold.release);
    lasts = lasts || std::isinf(hold.release);
  }
  for (const TimedLoad& load : trial.loads) {
    collector.at(load.from);
    collector.at(load.to);
    lasts = lasts || std::isinf(load.to);
  }
  if (trial.base) collector.path(*trial.base, std::numeric_limits<double>::infinity());
  for (const MeasuredEvent& event : trial.events)
    if (event.is_detachment()) collector.at(event.time);
  collector.times_.over = !lasts;
  return collector.times_;
}

}  // namespace pedicel::discrepancy
