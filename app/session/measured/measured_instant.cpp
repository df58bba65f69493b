#include "app/session/measured/measured_instant.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/session/measured/between_samples.h"

namespace pedicel::app {

namespace {

Vec3 point(const Eigen::MatrixXd& table, const BetweenSamples& at, Eigen::Index column) {
  const Vec3 low = table.block<1, 3>(at.low, column).transpose();
  if (at.share == 0.0) return low;
  const Vec3 high = table.block<1, 3>(at.high, column).transpose();
  return low + at.share * (high - low);
}

}  // namespace

std::optional<MeasuredInstant> instant_of(const MeasuredData& data, int trial,
                                          discrepancy::Model model, double time) {
  const discrepancy::Experiment* experiment = data.experiment();
  if (!experiment || trial < 0 || trial >= static_cast<int>(experiment->trials.size()))
    return std::nullopt;
  const discrepancy::Samples& seen = experiment->trials[static_cast<std::size_t>(trial)].markers;
  if (seen.time.empty()) return std::nullopt;
  MeasuredInstant instant;
  instant.time = std::clamp(time, seen.time.front(), seen.time.back());
  const BetweenSamples at = between_samples(seen.time, instant.time);
  const TrialPath* path = data.path(model, trial);
  double sum = 0.0;
  int count = 0;
  for (std::size_t m = 0; m < experiment->markers.size(); ++m) {
    const auto column = static_cast<Eigen::Index>(3 * m);
    MarkerInstant one{point(seen.value, at, column),
                      Vec3::Constant(std::numeric_limits<double>::quiet_NaN())};
    if (path) one.simulated = point(path->markers, at, column);
    if (one.error().allFinite()) sum += one.error().squaredNorm(), ++count;
    instant.markers.push_back(one);
  }
  instant.rms = count ? std::sqrt(sum / count) : std::numeric_limits<double>::quiet_NaN();
  if (!path) return instant;
  for (Eigen::Index c = 0; c < path->shape.cols(); c += 3)
    instant.shape.push_back(point(path->shape, at, c));
  return instant;
}

MeasuredSeries series_of(const MeasuredData& data, int trial, int marker, int axis) {
  MeasuredSeries series;
  const discrepancy::Experiment* experiment = data.experiment();
  if (!experiment || trial < 0 || trial >= static_cast<int>(experiment->trials.size()) ||
      marker < 0 || marker >= static_cast<int>(experiment->markers.size()))
    return series;
  const auto column = [&](const Eigen::MatrixXd& table) {
    const auto values = table.col(3 * marker + axis);
    return std::vector<double>(values.begin(), values.end());
  };
  const discrepancy::Samples& seen = experiment->trials[static_cast<std::size_t>(trial)].markers;
  series.time = seen.time;
  if (seen.time.empty()) return series;
  series.measured = column(seen.value);
  for (int m = 0; m < discrepancy::model_count; ++m)
    if (const TrialPath* path = data.path(static_cast<discrepancy::Model>(m), trial))
      series.models[static_cast<std::size_t>(m)] = column(path->markers);
  return series;
}

std::optional<MeasuredSeries> force_series_of(const MeasuredData& data, int trial, int axis) {
  const discrepancy::Experiment* experiment = data.experiment();
  if (!experiment || trial < 0 || trial >= static_cast<int>(experiment->trials.size()))
    return std::nullopt;
  const discrepancy::Samples& seen = experiment->trials[static_cast<std::size_t>(trial)].force;
  if (seen.time.empty()) return std::nullopt;
  const auto part = [&](const Eigen::MatrixXd& table) {
    const Eigen::VectorXd values =
        axis < 3 ? Eigen::VectorXd(table.col(axis)) : Eigen::VectorXd(table.rowwise().norm());
    return std::vector<double>(values.begin(), values.end());
  };
  MeasuredSeries series;
  series.time = seen.time;
  series.measured = part(seen.value);
  for (int m = 0; m < discrepancy::model_count; ++m) {
    const TrialPath* path = data.path(static_cast<discrepancy::Model>(m), trial);
    if (path && path->force.rows() == seen.value.rows())
      series.models[static_cast<std::size_t>(m)] = part(path->force);
  }
  return series;
}

}  // namespace pedicel::app
