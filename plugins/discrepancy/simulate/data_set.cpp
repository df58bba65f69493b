#include "pedicel/discrepancy/simulate/data_set.h"

#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

// In units of the noise: what a sample counts whose prediction failed. Far beyond any real
// residual, yet finite, so that a search can leave the place again.
constexpr double failed = 1.0e3;

// Data minus prediction; NaN where nothing was measured up to `end`.
Series column_residual(const Samples& samples, const Eigen::MatrixXd& prediction, int column,
                       double end, double unit) {
  Series residual = samples.value.col(column);
  for (int i = 0; i < residual.size(); ++i) {
    if (samples.time[i] > end) {
      residual[i] = std::numeric_limits<double>::quiet_NaN();
    } else if (std::isfinite(residual[i])) {
      residual[i] -= prediction(i, column);
      if (!std::isfinite(residual[i])) residual[i] = failed * unit;
    }
  }
  return residual;
}

template <class Call>
void for_each_channel(const Trial& trial, const Call& call) {
  for (int c = 0; c < trial.markers.value.cols(); ++c) call(trial.markers, c, false);
  for (int c = 0; c < trial.force.value.cols(); ++c) call(trial.force, c, true);
}

}  // namespace

DataSet::DataSet(const Experiment& experiment) : experiment_(&experiment) {}

void DataSet::set_noise(const Noise& position, const Noise& force) {
  position_ = position;
  force_ = force;
}

void DataSet::choose_noise(std::span<const Series> position, std::span<const Series> force,
                           const NoiseRule& rule) {
  const StatedNoise& stated = experiment_->noise;
  set_noise(discrepancy::choose_noise(position, stated.position_std.value_or(0.0), rule),
            discrepancy::choose_noise(force, stated.force_std.value_or(0.0), rule));
}

double DataSet::end_of(int trial, double horizon) const {
  if (horizon >= 1.0) return std::numeric_limits<double>::infinity();
  return horizon * experiment_->trials[trial].duration();
}

int DataSet::size(std::span<const int> trials) const {
  int count = 0;
  for (const int t : trials)
    for_each_channel(experiment_->trials[t],
                     [&](const Samples& samples, int, bool) { count += samples.size(); });
  return count;
}

int DataSet::samples(std::span<const int> trials, double horizon) const {
  int count = 0;
  for (const int t : trials) {
    const double end = end_of(t, horizon);
    for_each_channel(experiment_->trials[t], [&](const Samples& samples, int c, bool) {
      for (int i = 0; i < samples.size(); ++i)
        count += samples.time[i] <= end && std::isfinite(samples.value(i, c)) ? 1 : 0;
    });
  }
  return count;
}

void DataSet::residual(int trial, const Prediction& prediction, double horizon,
                       Eigen::Ref<Eigen::VectorXd> out) const {
  const double end = end_of(trial, horizon);
  Eigen::Index place = 0;
  for_each_channel(experiment_->trials[trial], [&](const Samples& samples, int c, bool is_force) {
    const Noise& noise = is_force ? force_ : position_;
    const Series raw = column_residual(samples, is_force ? prediction.force : prediction.markers, c,
                                       end, noise.std);
    const Eigen::VectorXd white = whiten(raw, noise);
    for (const double w : white) out[place++] = std::isfinite(w) ? w : 0.0;
  });
}

Eigen::MatrixXd DataSet::scaled_residual(int trial, const Prediction& prediction) const {
  const Trial& t = experiment_->trials[trial];
  const Eigen::Index rows = std::max(t.markers.value.rows(), t.force.value.rows());
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Constant(rows, t.markers.value.cols() + t.force.value.cols(),
                                std::numeric_limits<double>::quiet_NaN());
  Eigen::Index column = 0;
  for_each_channel(t, [&](const Samples& samples, int c, bool is_force) {
    const double std = is_force ? force_.std : position_.std;
    const Series raw = column_residual(samples, is_force ? prediction.force : prediction.markers, c,
                                       std::numeric_limits<double>::infinity(), std);
    result.col(column++).head(raw.size()) = raw / std;
  });
  return result;
}

void DataSet::raw_residuals(int trial, const Prediction& prediction, std::vector<Series>& position,
                            std::vector<Series>& force) const {
  const double end = std::numeric_limits<double>::infinity();
  for_each_channel(experiment_->trials[trial], [&](const Samples& samples, int c, bool is_force) {
    (is_force ? force : position)
        .push_back(column_residual(samples, is_force ? prediction.force : prediction.markers, c,
                                   end, is_force ? force_.std : position_.std));
  });
}

double DataSet::rms(std::span<const int> trials, std::span<const Prediction> predictions) const {
  double sum = 0.0;
  int count = 0;
  for (const int t : trials) {
    const Eigen::MatrixXd r = scaled_residual(t, predictions[t]);
    for (const double x : r.reshaped())
      if (std::isfinite(x)) {
        sum += x * x;
        ++count;
      }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

void measured_series(const Experiment& experiment, std::vector<Series>& position,
                     std::vector<Series>& force) {
  for (const Trial& trial : experiment.trials)
    for_each_channel(trial, [&](const Samples& samples, int c, bool is_force) {
      (is_force ? force : position).push_back(samples.value.col(c));
    });
}

}  // namespace pedicel::discrepancy
