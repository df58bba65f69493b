#include "app/session/measured/scene_instant.h"

#include <limits>

#include "app/session/measured/between_samples.h"

namespace pedicel::app {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

const discrepancy::Trial* trial_of(const MeasuredScene& scene, int trial) {
  const discrepancy::Experiment* experiment = scene.experiment();
  if (!experiment || trial < 0 || trial >= static_cast<int>(experiment->trials.size()))
    return nullptr;
  return &experiment->trials[static_cast<std::size_t>(trial)];
}

/// A row of a table of points, unknown where there is no table.
template <int Axes>
Eigen::Matrix<double, Axes, 1> point(const Eigen::RowVectorXd& row, std::size_t index) {
  const auto first = static_cast<Eigen::Index>(Axes * index);
  if (row.size() < first + Axes) return Eigen::Matrix<double, Axes, 1>::Constant(unknown);
  return row.segment<Axes>(first).transpose();
}

Eigen::RowVectorXd row_at(const std::vector<double>& time, const Eigen::MatrixXd& table, double t) {
  if (time.empty() || table.rows() != static_cast<Eigen::Index>(time.size())) return {};
  return between_samples(time, t).row(table);
}

}  // namespace

SceneInstant scene_instant_of(const MeasuredScene& scene, int trial, discrepancy::Model model,
                              double time) {
  SceneInstant instant;
  const discrepancy::Trial* own = trial_of(scene, trial);
  if (!own) return instant;
  const ScenePath* path = scene.path(model, trial);
  const Eigen::RowVectorXd seen = row_at(own->markers.time, own->markers.value, time);
  const Eigen::RowVectorXd said =
      path ? row_at(path->time, path->places, time) : Eigen::RowVectorXd();
  for (std::size_t m = 0; m < scene.experiment()->markers.size(); ++m)
    instant.markers.push_back({point<3>(seen, m), point<3>(said, m)});
  if (!path) return instant;
  const Eigen::RowVectorXd shape = row_at(path->time, path->shape, time);
  for (Eigen::Index p = 0; 3 * p < shape.size(); ++p)
    instant.shape.push_back(shape.segment<3>(3 * p).transpose());
  return instant;
}

std::vector<ImageInstant> image_instant_of(const MeasuredScene& scene, int trial,
                                           discrepancy::Model model, int camera, double time) {
  std::vector<ImageInstant> all;
  const discrepancy::Trial* own = trial_of(scene, trial);
  if (!own || camera < 0 || camera >= static_cast<int>(own->pixels.size())) return all;
  const auto c = static_cast<std::size_t>(camera);
  const discrepancy::Samples& image = own->pixels[c];
  if (image.size() == 0) return all;
  const ScenePath* path = scene.path(model, trial);
  const Eigen::RowVectorXd seen = row_at(image.time, image.value, time);
  const Eigen::RowVectorXd said =
      path ? row_at(image.time, path->readings.pixels[c], time) : Eigen::RowVectorXd();
  for (std::size_t m = 0; m < scene.experiment()->markers.size(); ++m)
    all.push_back({point<2>(seen, m), point<2>(said, m)});
  return all;
}

MeasuredSeries scene_series_of(const MeasuredScene& scene, int trial,
                               const SceneInstrument& instrument, int column) {
  MeasuredSeries series;
  const discrepancy::Trial* own = trial_of(scene, trial);
  if (!own || column < 0 || column >= static_cast<int>(instrument.columns.size())) return series;
  const discrepancy::Samples& seen = measured_by(instrument, *own);
  const auto values = [&](const Eigen::MatrixXd& table) {
    const Eigen::VectorXd scaled = instrument.scale * table.col(instrument.first + column);
    return std::vector<double>(scaled.begin(), scaled.end());
  };
  series.time = seen.time;
  series.measured = values(seen.value);
  for (int m = 0; m < discrepancy::model_count; ++m) {
    const ScenePath* path = scene.path(static_cast<discrepancy::Model>(m), trial);
    if (!path || !path->healthy) continue;
    series.models[static_cast<std::size_t>(m)] = values(said_by(instrument, path->readings));
  }
  return series;
}

}  // namespace pedicel::app
