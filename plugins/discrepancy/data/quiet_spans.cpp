#include "plugins/discrepancy/data/quiet_spans.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pedicel::discrepancy {

namespace {

constexpr double window = 0.4, hop = 0.1;  // s
// Where a slow swing goes through its middle it keeps to a line for half a second.
constexpr double least_span = 0.8;  // s
// Samples of a window: fewer do not show a swing between them.
constexpr int fewest = 8;
// Times the noise: the RMS of noise alone about a line is 1 +- 0.2 in so few samples, and that of
// a swing of 1.6 noise deviations is 1.5.
constexpr double most_scatter = 1.5;
// Of a marker's noise: what drives the plant is known, and goes through it step by step.
constexpr double most_driven = 0.3;
constexpr int path_points = 16;
constexpr double same_time = 1.0e-9;  // s

/// Sums of points (t, x), for the mean square about their straight line.
class Line {
 public:
  void add(double t, double x) {
    ++count_;
    t_ += t;
    x_ += x;
    tt_ += t * t;
    tx_ += t * x;
    xx_ += x * x;
  }
  int count() const { return count_; }
  double square() const {
    const double n = count_;
    const double tt = tt_ - t_ * t_ / n, tx = tx_ - t_ * x_ / n, xx = xx_ - x_ * x_ / n;
    return std::max(0.0, xx - (tt > 0.0 ? tx * tx / tt : 0.0)) / std::max(1.0, n - 2.0);
  }

 private:
  int count_ = 0;
  double t_ = 0.0, x_ = 0.0, tt_ = 0.0, tx_ = 0.0, xx_ = 0.0;
};

// Whether the columns from `first` on keep to lines. Nothing where too little was measured.
std::optional<bool> keeps_still(const Samples& samples, int first, int columns, double std,
                                const TimeSpan& within) {
  const auto begin =
      std::lower_bound(samples.time.begin(), samples.time.end(), within.begin - same_time) -
      samples.time.begin();
  const auto end =
      std::upper_bound(samples.time.begin(), samples.time.end(), within.end + same_time) -
      samples.time.begin();
  bool seen = false;
  for (int c = first; c < first + columns; ++c) {
    Line line;
    // Beside the first sample, so that squares of large coordinates do not swallow the noise.
    double origin = 0.0;
    for (auto i = begin; i < end; ++i) {
      const double x = samples.value(i, c);
      if (!std::isfinite(x)) continue;
      if (line.count() == 0) origin = x;
      line.add(samples.time[i] - within.begin, x - origin);
    }
    if (line.count() < fewest) continue;
    seen = true;
    if (line.square() > most_scatter * most_scatter * std * std) return false;
  }
  return seen ? std::optional(true) : std::nullopt;
}

bool keeps_still(const DrivenPath& path, double std, const TimeSpan& within) {
  Line lines[3];
  const Vec3 origin = path.position_at(within.begin);
  for (int k = 0; k <= path_points; ++k) {
    const double t = window * k / path_points;
    const Vec3 there = path.position_at(within.begin + t) - origin;
    for (int i = 0; i < 3; ++i) lines[i].add(t, there[i]);
  }
  return std::ranges::all_of(lines, [&](const Line& line) {
    return line.square() <= most_driven * most_driven * std * std;
  });
}

bool turns(const DrivenPath& path) {
  return std::ranges::any_of(path.rotation, [&](const Quat& q) {
    return q.angularDistance(path.rotation.front()) > 1.0e-6;
  });
}

bool is_quiet(const Trial& trial, const NoiseLevels& noise, const TimeSpan& within) {
  const auto jumps = [&](double t) { return t > within.begin && t < within.end; };
  for (const Hold& hold : trial.holds) {
    if (jumps(hold.release)) return false;
    if (within.begin < hold.release && !keeps_still(hold.path, noise.position, within))
      return false;
  }
  for (const TimedLoad& load : trial.loads)
    if (jumps(load.from) || jumps(load.to)) return false;
  if (trial.base && !keeps_still(*trial.base, noise.position, within)) return false;
  const int columns = static_cast<int>(trial.markers.value.cols());
  if (!keeps_still(trial.markers, 0, columns, noise.position, within).value_or(false)) return false;
  if (trial.force.size() > 0 && !keeps_still(trial.force, 0, 3, noise.force, within).value_or(true))
    return false;
  if (trial.wrench.size() == 0) return true;
  return keeps_still(trial.wrench, 0, 3, noise.force, within).value_or(true) &&
         keeps_still(trial.wrench, 3, 3, noise.moment, within).value_or(true);
}

}  // namespace

std::vector<TimeSpan> quiet_spans(const Trial& trial, const NoiseLevels& noise) {
  std::vector<TimeSpan> spans;
  if (trial.is_static || !trial.events.empty()) return spans;
  if (trial.base && turns(*trial.base)) return spans;
  for (const Hold& hold : trial.holds)
    if (turns(hold.path)) return spans;
  // What begins in motion is not at rest in its first samples, whatever these show.
  const double first = trial.window.value_or(0.0);
  for (double begin = first; begin + window <= trial.duration() + same_time; begin += hop) {
    const TimeSpan within{begin, begin + window};
    if (!is_quiet(trial, noise, within)) continue;
    if (!spans.empty() && begin <= spans.back().end + same_time)
      spans.back().end = within.end;
    else
      spans.push_back(within);
  }
  // What moves afterwards may have begun within the last window.
  for (TimeSpan& span : spans)
    if (span.end < trial.duration() - same_time) span.end -= hop;
  std::erase_if(spans, [](const TimeSpan& span) { return span.end - span.begin < least_span; });
  return spans;
}

}  // namespace pedicel::discrepancy
