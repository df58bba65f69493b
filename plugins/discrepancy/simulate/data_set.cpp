#include "plugins/discrepancy/simulate/data_set.h"

#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

// In units of the noise: what a sample counts whose prediction failed. Far beyond any real
// residual, yet finite, so that a search can leave the place again.
constexpr double failed = 1.0e3;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double seen_start = 1.0e-6;  // of the largest direction: less is none of its own

constexpr int first_moment = 3;  // column of a wrench

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

// A direction where something was measured, as column_residual() has it.
Series column_change(const Samples& samples, const Eigen::MatrixXd& change, int column) {
  Series result = samples.value.col(column);
  for (int i = 0; i < result.size(); ++i)
    if (std::isfinite(result[i]))
      result[i] = std::isfinite(change(i, column)) ? change(i, column) : 0.0;
  return result;
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0 || columns.isZero(0.0)) return Eigen::MatrixXd(columns.rows(), 0);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(seen_start);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

template <class Call>
void for_each_table(const Trial& trial, const Call& call) {
  for (int c = 0; c < trial.markers.value.cols(); ++c)
    call(trial.markers, c, ChannelKind::position);
  for (int c = 0; c < trial.force.value.cols(); ++c) call(trial.force, c, ChannelKind::force);
  for (int c = 0; c < trial.wrench.value.cols(); ++c)
    call(trial.wrench, c, c < first_moment ? ChannelKind::force : ChannelKind::moment);
}

std::vector<Series>& series_of(AllSeries& all, ChannelKind kind) {
  return kind == ChannelKind::position ? all.position
         : kind == ChannelKind::force  ? all.force
                                       : all.moment;
}

}  // namespace

struct DataSet::Channel {
  const Samples* samples;
  Eigen::MatrixXd Prediction::*part;
  int column;
  ChannelKind kind;
  Eigen::Index number;  // in the trial
};

template <class Call>
void DataSet::for_each_channel(int trial, const Call& call) const {
  const Trial& one = experiment_->trials[trial];
  Eigen::Index number = 0;
  for_each_table(one, [&](const Samples& samples, int column, ChannelKind kind) {
    const auto part = &samples == &one.markers ? &Prediction::markers
                      : &samples == &one.force ? &Prediction::force
                                               : &Prediction::wrench;
    call(Channel{&samples, part, column, kind, number++});
  });
}

DataSet::DataSet(const Experiment& experiment)
    : experiment_(&experiment),
      path_noise_(path_noise(experiment)),
      freedom_(experiment.trials.size()) {}

const Noise& DataSet::noise_of(const Channel& channel) const {
  return channel.kind == ChannelKind::position ? position_
         : channel.kind == ChannelKind::force  ? force_
                                               : moment_;
}

// Of each sample: less where the noise of a path comes on top of the sensor's.
Eigen::VectorXd DataSet::weights(int trial, const Channel& channel) const {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(channel.samples->size());
  const PathNoise& path = path_noise_[trial];
  if (path.variance.size() == 0) return weight;
  const double std = noise_of(channel).std;
  const double led = std / std::sqrt(std * std + path.variance[channel.number]);
  for (int i = 0; i < channel.samples->size() && channel.samples->time[i] < path.until; ++i)
    weight[i] = led;
  return weight;
}

void DataSet::set_noise(const Noise& position, const Noise& force) {
  position_ = position;
  force_ = force;
  for (std::size_t t = 0; t < freedom_.size(); ++t) renew_freedom(static_cast<int>(t));
}

void DataSet::set_moment_noise(const Noise& moment) {
  moment_ = moment;
  for (std::size_t t = 0; t < freedom_.size(); ++t) renew_freedom(static_cast<int>(t));
}

void DataSet::choose_noise(const AllSeries& series, const NoiseRule& rule) {
  const StatedNoise& stated = experiment_->noise;
  moment_ = discrepancy::choose_noise(series.moment, stated.moment_std.value_or(0.0), rule);
  set_noise(discrepancy::choose_noise(series.position, stated.position_std.value_or(0.0), rule),
            discrepancy::choose_noise(series.force, stated.force_std.value_or(0.0), rule));
}

void DataSet::set_start_directions(int trial, std::vector<Prediction> directions) {
  freedom_[trial].directions = std::move(directions);
  renew_freedom(trial);
}

void DataSet::renew_freedom(int trial) {
  Freedom& freedom = freedom_[trial];
  const auto count = static_cast<Eigen::Index>(freedom.directions.size());
  if (count == 0) return;
  freedom.white.setZero(size(std::span(&trial, 1)), count);
  Eigen::MatrixXd plain = freedom.white;
  Eigen::Index row = 0;
  for_each_channel(trial, [&](const Channel& channel) {
    const Noise& noise = noise_of(channel);
    const Eigen::VectorXd weight = weights(trial, channel);
    for (Eigen::Index d = 0; d < count; ++d) {
      const Series change =
          column_change(*channel.samples, freedom.directions[d].*channel.part, channel.column)
              .cwiseProduct(weight);
      const Eigen::VectorXd white = whiten(change, noise);
      for (Eigen::Index i = 0; i < white.size(); ++i) {
        freedom.white(row + i, d) = std::isfinite(white[i]) ? white[i] : 0.0;
        plain(row + i, d) = std::isfinite(change[i]) ? change[i] / noise.std : 0.0;
      }
    }
    row += channel.samples->size();
  });
  freedom.white_basis = orthonormal(freedom.white);
  freedom.scaled_basis = orthonormal(plain);
}

void DataSet::leave_out_start(int trial, double end, Eigen::Ref<Eigen::VectorXd> residual) const {
  const Freedom& freedom = freedom_[trial];
  if (freedom.directions.empty()) return;
  if (std::isinf(end)) {
    residual -= freedom.white_basis * (freedom.white_basis.transpose() * residual);
    return;
  }
  Eigen::MatrixXd begun = freedom.white;
  Eigen::Index row = 0;
  for_each_channel(trial, [&](const Channel& channel) {
    for (int i = 0; i < channel.samples->size(); ++i, ++row)
      if (channel.samples->time[i] > end) begun.row(row).setZero();
  });
  const Eigen::MatrixXd basis = orthonormal(begun);
  residual -= basis * (basis.transpose() * residual);
}

double DataSet::end_of(int trial, double horizon) const {
  if (horizon >= 1.0) return infinity;
  return horizon * experiment_->trials[trial].duration();
}

int DataSet::size(std::span<const int> trials) const {
  int count = 0;
  for (const int t : trials)
    for_each_table(experiment_->trials[t],
                   [&](const Samples& samples, int, ChannelKind) { count += samples.size(); });
  return count;
}

int DataSet::samples(std::span<const int> trials, double horizon) const {
  int count = 0;
  for (const int t : trials) {
    const double end = end_of(t, horizon);
    for_each_table(experiment_->trials[t], [&](const Samples& samples, int c, ChannelKind) {
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
  for_each_channel(trial, [&](const Channel& channel) {
    const Noise& noise = noise_of(channel);
    Series raw =
        column_residual(*channel.samples, prediction.*channel.part, channel.column, end, noise.std);
    if (path_noise_[trial].variance.size() > 0) raw.array() *= weights(trial, channel).array();
    // Rows of rest have no order in time that noise could have a memory in.
    const bool rest = experiment_->trials[trial].is_static;
    const Eigen::VectorXd white = rest ? Eigen::VectorXd(raw / noise.std) : whiten(raw, noise);
    for (const double w : white) out[place++] = std::isfinite(w) ? w : 0.0;
  });
  leave_out_start(trial, end, out.head(place));
}

Eigen::MatrixXd DataSet::scaled(int trial, const Prediction& prediction) const {
  const Trial& t = experiment_->trials[trial];
  const Eigen::Index rows =
      std::max({t.markers.value.rows(), t.force.value.rows(), t.wrench.value.rows()});
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(
      rows, t.markers.value.cols() + t.force.value.cols() + t.wrench.value.cols(),
      std::numeric_limits<double>::quiet_NaN());
  for_each_channel(trial, [&](const Channel& channel) {
    const double std = noise_of(channel).std;
    Series raw =
        column_residual(*channel.samples, prediction.*channel.part, channel.column, infinity, std);
    if (path_noise_[trial].variance.size() > 0) raw.array() *= weights(trial, channel).array();
    result.col(channel.number).head(raw.size()) = raw / std;
  });
  return result;
}

Eigen::MatrixXd DataSet::scaled_residual(int trial, const Prediction& prediction) const {
  Eigen::MatrixXd result = scaled(trial, prediction);
  const Eigen::MatrixXd& basis = freedom_[trial].scaled_basis;
  if (basis.cols() == 0) return result;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(basis.rows());
  const auto for_each_entry = [&](const auto& call) {
    Eigen::Index row = 0;
    for_each_channel(trial, [&](const Channel& channel) {
      for (int i = 0; i < channel.samples->size(); ++i, ++row)
        if (double& entry = result(i, channel.number); std::isfinite(entry)) call(entry, all[row]);
    });
  };
  for_each_entry([](const double& entry, double& one) { one = entry; });
  all -= basis * (basis.transpose() * all);
  for_each_entry([](double& entry, const double& one) { entry = one; });
  return result;
}

void DataSet::raw_residuals(int trial, const Prediction& prediction, AllSeries& series) const {
  if (experiment_->trials[trial].is_static) return;
  for_each_channel(trial, [&](const Channel& channel) {
    series_of(series, channel.kind)
        .push_back(column_residual(*channel.samples, prediction.*channel.part, channel.column,
                                   infinity, noise_of(channel).std));
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

AllSeries measured_series(const Experiment& experiment) {
  AllSeries all;
  for (const Trial& trial : experiment.trials) {
    if (trial.is_static) continue;
    for_each_table(trial, [&](const Samples& samples, int c, ChannelKind kind) {
      series_of(all, kind).push_back(samples.value.col(c));
    });
  }
  return all;
}

}  // namespace pedicel::discrepancy
