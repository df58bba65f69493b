// Clocks that run a little fast. What is led stiffly is where its path is; a clock that is one per
// cent off leaves it ever later behind. A latency stays what it is, and so does what a soft grip,
// friction or creep make of the way, which bend it without leaving it behind.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "pedicel/discrepancy/admission/beside.h"
#include "pedicel/discrepancy/data/sentence.h"

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

  double left(int count) const {
    const Eigen::MatrixXd part = of.leftCols(count);
    return (way - part * part.colPivHouseholderQr().solve(way)).squaredNorm();
  }
};

Regression regression(const Beside& beside, const Vec3& along) {
  const Track& track = beside.track();
  const DrivenPath& path = *beside.drive().path;
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
    r.of.row(i) << 1.0, share, share * share, u, share * u, v, t * v;
    r.way[i] = track.place[rows[i]].dot(along);
    ways += u * u;
    mean += u / static_cast<double>(count);
    speeds += v * v;
  }
  ways -= static_cast<double>(count) * mean * mean;
  r.last = end;
  r.swing = ways > 0.0 ? std::sqrt(speeds / ways) : 0.0;
  return r;
}

std::optional<Fault> runs_away(const Beside& beside) {
  if (!beside.drive().path || beside.drive().kind != Drive::Kind::hold) return std::nullopt;
  const Following f = beside.follow();
  if (f.rows < least_rows || f.explained() < agrees) return std::nullopt;
  const Regression r = regression(beside, f.along);
  if (r.way.size() < least_rows || r.swing <= 0.0) return std::nullopt;
  const double with = r.left(terms), without = r.left(terms - 1);
  if (with > much_better * without) return std::nullopt;
  const Eigen::VectorXd numbers = r.of.colPivHouseholderQr().solve(r.way);
  const double gain = numbers[3] + 0.5 * numbers[4];
  if (gain < stiffly || gain > 1.0 / stiffly) return std::nullopt;
  const double rate = -numbers[terms - 1] / gain, drift = rate * r.last;
  const Eigen::MatrixXd inverse = (r.of.transpose() * r.of).inverse();
  const double error =
      std::sqrt(with / static_cast<double>(r.way.size() - terms) * inverse(terms - 1, terms - 1)) /
      gain;
  if (std::abs(rate) < std::max(least_rate, sure * error) || std::abs(rate) > most_rate)
    return std::nullopt;
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
