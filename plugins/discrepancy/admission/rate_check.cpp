// Clocks that run a little fast. What is led stiffly is where its path is; a clock that is one per
// cent off leaves it ever later behind. A latency stays what it is, and so does what a soft grip,
// friction or creep make of the way, which bend it without leaving it behind.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/beside.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

constexpr double stiffly = 0.9;       // of the path's way goes the marker at least
constexpr double agrees = 0.85;       // of its motion is the path's, on the clock as it is
constexpr double least_rate = 3e-3;   // 1: clocks of cameras are better
constexpr double most_rate = 0.3;     // beyond, drive_check tells it
constexpr double least_drift = 0.04;  // s, over the record
constexpr double sure = 6.0;          // deviations; what is left over is not white
constexpr double much_better = 0.5;   // of the square of what is left
// Of the angle by which the way may come to lag because the marker does not go all of it: friction
// begins without a lag.
constexpr double beyond_lag = 1.3;
constexpr int least_rows = 60, terms = 7;
constexpr double at_first = 0.1;  // s: what is moved from rest swings first

// From both sides over some rows, because a path is linear between its rows and its speed jumps at
// each.
Vec3 speed(const DrivenPath& path, double t) {
  constexpr double step = 1.0e-2;  // s
  const double from = std::max(t - step, path.time.front());
  const double to = std::min(t + step, path.time.back());
  return to > from ? Vec3((path.position_at(to) - path.position_at(from)) / (to - from))
                   : Vec3(Vec3::Zero());
}

/// The marker along the path's main direction, as a sum of: a place that drifts, the path's way and
/// one that changes, its speed (a delay), and its speed times time (a rate).
struct Regression {
  Eigen::MatrixXd of;   ///< rows x terms; the rate's is the last
  Eigen::VectorXd way;  ///< m
  double last = 0.0;    ///< s, of the record
  double swing = 0.0;   ///< 1/s, rms speed over rms way

  // Whether the rate is needed is asked by leaving it out, with all others fitted anew.
  double left(int count) const {
    const Eigen::MatrixXd part = of.leftCols(count);
    return (way - part * part.colPivHouseholderQr().solve(way)).squaredNorm();
  }
};

Regression regression(const Beside& beside, const Vec3& along) {
  const Track& track = beside.track();
  const DrivenPath& path = *beside.drive().path;
  // While it is led, and not after: at its end a path stands still and tells no time.
  const double end = std::min(beside.drive().until, path.time.back());
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < track.time.size(); ++i)
    if (track.time[i] > path.time.front() + at_first && track.time[i] < end - at_first)
      rows.push_back(i);
  Regression r;
  const auto count = static_cast<Eigen::Index>(rows.size());
  r.of.resize(count, terms);
  r.way.resize(count);
  double ways = 0.0, speeds = 0.0, mean = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t = track.time[rows[i]], share = t / end;
    const double u = (path.position_at(t) - path.position.front()).dot(along);
    const double v = speed(path, t).dot(along);
    // What else may bend the way has terms of its own: a frame that drifts, a grip that creeps, a
    // constant delay. To first order a path read at t - delay - rate t is u - delay v - rate t v.
    r.of.row(i) << 1.0, share, share * share, u, share * u, v, t * v;
    // Along the main way alone: across it the plant does as it likes.
    r.way[i] = track.place[rows[i]].dot(along);
    ways += u * u;
    mean += u / static_cast<double>(count);
    speeds += v * v;
  }
  // About its mean, as a way has no origin.
  ways -= static_cast<double>(count) * mean * mean;
  r.last = end;
  r.swing = ways > 0.0 ? std::sqrt(speeds / ways) : 0.0;
  return r;
}

std::optional<Fault> runs_away(const Beside& beside) {
  // A base shakes the plant, whose marker swings after it: that is no clock.
  if (!beside.drive().path || beside.drive().kind != Drive::Kind::hold) return std::nullopt;
  const Following f = beside.follow();
  // Small rates leave the marker near its path. Where it is not, drive_check has been asked
  // already.
  if (f.rows < least_rows || f.explained() < agrees) return std::nullopt;
  const Regression r = regression(beside, f.along);
  if (r.way.size() < least_rows || r.swing <= 0.0) return std::nullopt;
  // By what it explains first. A rate that explains little may still be significant where noise is
  // small, through anything that bends the way a little.
  const double with = r.left(terms), without = r.left(terms - 1);
  if (with > much_better * without) return std::nullopt;
  const Eigen::VectorXd numbers = r.of.colPivHouseholderQr().solve(r.way);
  // At the middle of the record.
  const double gain = numbers[3] + 0.5 * numbers[4];
  if (gain < stiffly || gain > 1.0 / stiffly) return std::nullopt;
  const double rate = -numbers[terms - 1] / gain, drift = rate * r.last;
  // The usual error of least squares, by what is left; six of them are asked for, because that is
  // not white.
  const Eigen::MatrixXd inverse = (r.of.transpose() * r.of).inverse();
  const double error =
      std::sqrt(with / static_cast<double>(r.way.size() - terms) * inverse(terms - 1, terms - 1)) /
      gain;
  if (std::abs(rate) < std::max(least_rate, sure * error) || std::abs(rate) > most_rate)
    return std::nullopt;
  // Two more conditions: by the end it must be seconds that matter, and more than a marker lags
  // that does not go all of its way.
  if (std::abs(drift) < least_drift ||
      std::abs(drift) * r.swing < beyond_lag * std::abs(1.0 - gain))
    return std::nullopt;
  return Fault{"markers.csv",
               text("has a clock that runs %.4g times as fast as that of ", 1.0 / (1.0 - rate)) +
                   beside.what() + ": " + beside.marker() +
                   text(" is left behind by %.2g s in %.3g s", drift, r.last) +
                   ": expected seconds since the trial began, the same in all its tables; another "
                   "rate of frames?"};
}

}  // namespace

std::optional<Fault> check_rate(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  for (const Beside& beside : Beside::all_of(view))
    if (auto fault = runs_away(beside)) return fault;
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
