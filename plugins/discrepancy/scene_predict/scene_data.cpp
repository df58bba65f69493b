#include "plugins/discrepancy/scene_predict/scene_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

/// In units of the noise: what a sample counts whose prediction failed.
constexpr double failed = 1.0e3;

/// call(samples, prediction or null, column of both, kind)
template <class Call>
void for_each_channel(const Trial& trial, const SceneReadings* readings, const Call& call) {
  const auto table = [&](const Samples& samples, const Eigen::MatrixXd* predicted,
                         const auto& kind) {
    for (long c = 0; c < samples.value.cols(); ++c) call(samples, predicted, c, kind(c));
  };
  table(trial.markers, readings ? &readings->markers : nullptr,
        [](long) { return SceneChannel::position; });
  for (std::size_t i = 0; i < trial.pixels.size(); ++i)
    table(trial.pixels[i], readings ? &readings->pixels[i] : nullptr,
          [](long) { return SceneChannel::pixel; });
  for (std::size_t i = 0; i < trial.wrenches.size(); ++i)
    table(trial.wrenches[i], readings ? &readings->wrenches[i] : nullptr,
          [](long c) { return c < 3 ? SceneChannel::force : SceneChannel::moment; });
  table(trial.torques, readings ? &readings->torques : nullptr,
        [](long) { return SceneChannel::torque; });
  // Elsewhere they drive the model.
  if (trial.follows_commands)
    table(trial.joints, readings ? &readings->joints : nullptr,
          [](long) { return SceneChannel::joint; });
}

// Of a normal number: below it lies a share p of all.
double normal_quantile(double p) {
  double low = -8.0, high = 8.0;
  for (int halving = 0; halving < 40; ++halving) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(-z / std::sqrt(2.0)) < p ? low : high) = z;
  }
  return 0.5 * (low + high);
}

// What the sorted `one` of `count` estimates of a variance comes to on average, as a share of the
// variance, where each is the mean of so many squared third differences of white noise.
double expected_share(long one, long count, double squares) {
  // Neighbouring third differences have 0.75, 0.3 and 0.05 of their scatter in common, so the mean
  // of n squares scatters as that of n / 2.31 independent ones.
  const double freedom = squares / 2.31;
  // Where it stands among normal numbers (Blom 1958), and what chi squared has there (Wilson and
  // Hilferty 1931).
  const double p = (static_cast<double>(one) + 0.625) / (static_cast<double>(count) + 0.25);
  const double z = normal_quantile(p), part = 2.0 / (9.0 * freedom);
  return std::pow(std::max(0.1, 1.0 - part + z * std::sqrt(part)), 3);
}

// Of white noise on something smooth: a parabola through neighbours leaves 20 variances.
double scatter(const Eigen::VectorXd& x) {
  std::vector<double> parts;
  const long length = std::max(8L, x.size() / 10);
  double squares = 0.0;
  for (long first = 0; first + length <= x.size(); first += length) {
    double square = 0.0;
    int count = 0;
    for (long i = first; i + 3 < first + length; ++i) {
      const double d = x[i + 3] - 3.0 * x[i + 2] + 3.0 * x[i + 1] - x[i];
      if (!std::isfinite(d)) continue;
      square += d * d / 20.0;
      ++count;
    }
    if (count <= length / 2) continue;
    parts.push_back(square / count);
    squares += count;
  }
  if (parts.empty()) return 0.0;
  // A low one, as most parts may have more in them than noise, such as a touch.
  const auto low = static_cast<long>(parts.size() / 4), all = static_cast<long>(parts.size());
  std::ranges::nth_element(parts, parts.begin() + low);
  // A low one of several is below what noise has on average. Taken as it is, noise of 24 samples a
  // part came out a fifth too small, and null cases as unknown.
  return std::sqrt(parts[static_cast<std::size_t>(low)] /
                   expected_share(low, all, squares / static_cast<double>(all)));
}

/// s, to either side: a contact that breaks loose does so sooner or later.
constexpr double uncertain = 0.04;

// The mean of what is near in time.
Eigen::VectorXd around(const std::vector<double>& time, const Eigen::VectorXd& x) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size() + 1), out(x.size());
  for (long i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  long first = 0, last = 0;
  for (long i = 0; i < x.size(); ++i) {
    const double t = time[static_cast<std::size_t>(i)];
    while (time[static_cast<std::size_t>(first)] < t - uncertain) ++first;
    while (last < x.size() && time[static_cast<std::size_t>(last)] <= t + uncertain) ++last;
    out[i] = (sum[last] - sum[first]) / static_cast<double>(last - first);
  }
  return out;
}

}  // namespace

const char* channel_name(SceneChannel kind) {
  constexpr const char* names[] = {"position", "pixel", "force", "moment", "torque", "joint"};
  return names[static_cast<std::size_t>(kind)];
}

SceneDataSet::SceneDataSet(const Experiment& experiment) : experiment_(&experiment) {
  const StatedNoise& noise = experiment.noise;
  const std::optional<double> stated[] = {noise.position_std, noise.pixel_std,  noise.force_std,
                                          noise.moment_std,   noise.torque_std, noise.joint_std};
  for (std::size_t k = 0; k < deviation_.size(); ++k) {
    if (stated[k]) {
      deviation_[k] = *stated[k];
      continue;
    }
    double square = 0.0;
    int count = 0;
    for (const Trial& trial : experiment.trials)
      for_each_channel(
          trial, nullptr,
          [&](const Samples& samples, const Eigen::MatrixXd*, long c, SceneChannel kind) {
            if (static_cast<std::size_t>(kind) != k) return;
            const double own = scatter(samples.value.col(c));
            if (own == 0.0) return;
            square += own * own;
            ++count;
          });
    deviation_[k] = count > 0 ? std::sqrt(square / count) : 1.0;
  }
}

int SceneDataSet::size(int trial) const {
  int count = 0;
  for_each_channel(experiment_->trials[static_cast<std::size_t>(trial)], nullptr,
                   [&](const Samples& samples, const Eigen::MatrixXd*, long, SceneChannel) {
                     count += samples.size();
                   });
  return count;
}

int SceneDataSet::samples(int trial, double until) const {
  int count = 0;
  for_each_channel(experiment_->trials[static_cast<std::size_t>(trial)], nullptr,
                   [&](const Samples& samples, const Eigen::MatrixXd*, long c, SceneChannel) {
                     for (int i = 0; i < samples.size(); ++i)
                       count += samples.time[static_cast<std::size_t>(i)] <= until &&
                                        std::isfinite(samples.value(i, c))
                                    ? 1
                                    : 0;
                   });
  return count;
}

void SceneDataSet::residual(int trial, const SceneReadings& readings, double until,
                            Eigen::Ref<Eigen::VectorXd> out) const {
  long place = 0;
  for_each_channel(
      experiment_->trials[static_cast<std::size_t>(trial)], &readings,
      [&](const Samples& samples, const Eigen::MatrixXd* predicted, long c, SceneChannel kind) {
        for (int i = 0; i < samples.size(); ++i) {
          double r = 0.0;
          const double measured = samples.value(i, c);
          if (samples.time[static_cast<std::size_t>(i)] <= until && std::isfinite(measured)) {
            r = (measured - (*predicted)(i, c)) / deviation(kind);
            if (!std::isfinite(r)) r = failed;
            r *= weight(trial, place);
          }
          out[place++] = r;
        }
      });
}

std::vector<int> SceneDataSet::stretches(int trial, double length) const {
  std::vector<int> out;
  for_each_channel(
      experiment_->trials[static_cast<std::size_t>(trial)], nullptr,
      [&](const Samples& samples, const Eigen::MatrixXd*, long, SceneChannel kind) {
        for (const double time : samples.time)
          out.push_back(static_cast<int>((time - samples.time.front()) / length) * scene_channels +
                        static_cast<int>(kind));
      });
  return out;
}

std::array<Misfit, scene_channels> SceneDataSet::sums(int trial,
                                                      const SceneReadings& readings) const {
  std::array<Misfit, scene_channels> sums;
  long place = 0;
  for_each_channel(
      experiment_->trials[static_cast<std::size_t>(trial)], &readings,
      [&](const Samples& samples, const Eigen::MatrixXd* predicted, long c, SceneChannel kind) {
        Misfit& sum = sums[static_cast<std::size_t>(kind)];
        for (int i = 0; i < samples.size(); ++i, ++place) {
          const double measured = samples.value(i, c);
          if (!std::isfinite(measured)) continue;
          double r = (measured - (*predicted)(i, c)) / deviation(kind);
          if (!std::isfinite(r)) r = failed;
          r *= weight(trial, place);
          sum.square += r * r;
          ++sum.count;
        }
      });
  return sums;
}

void SceneDataSet::widen(int trial, const SceneReadings& reference,
                         std::span<const SceneReadings> others,
                         std::span<const SceneReadings> doubts) {
  const long rows = size(trial);
  Eigen::VectorXd own(rows), square = Eigen::VectorXd::Zero(rows), other(rows);
  weight_.resize(experiment_->trials.size());
  weight_[static_cast<std::size_t>(trial)].resize(0);
  const double always = std::numeric_limits<double>::infinity();
  residual(trial, reference, always, own);
  const auto add_mean_square = [&](std::span<const SceneReadings> all) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows);
    int count = 0;
    for (const SceneReadings& one : all) {
      if (!one.healthy) continue;
      residual(trial, one, always, other);
      sum += (other - own).cwiseAbs2();
      ++count;
    }
    if (count > 0) square += sum / count;
  };
  add_mean_square(others);
  add_mean_square(doubts);
  if (square.isZero(0.0)) return;
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(rows);
  long first = 0;
  for_each_channel(experiment_->trials[static_cast<std::size_t>(trial)], nullptr,
                   [&](const Samples& samples, const Eigen::MatrixXd*, long, SceneChannel) {
                     const long n = samples.size();
                     weight.segment(first, n) =
                         (1.0 + around(samples.time, square.segment(first, n)).array()).rsqrt();
                     first += n;
                   });
  weight_[static_cast<std::size_t>(trial)] = weight;
}

double SceneDataSet::beyond_noise(const Misfit& sum) {
  const double mean = sum.count > 0 ? sum.square / sum.count : 0.0;
  return mean > 1.0 ? std::sqrt(mean - 1.0) : 0.0;
}

}  // namespace pedicel::discrepancy
