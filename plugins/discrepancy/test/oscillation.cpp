#include "pedicel/discrepancy/test/oscillation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace pedicel::discrepancy {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr int passes = 30;

// Values and derivatives at one time.
void row_of(const Oscillation& o, double t, double& value, Eigen::Ref<Eigen::RowVectorXd> out) {
  const double e = std::exp(-o.decay * t), c = e * std::cos(o.w * t), s = e * std::sin(o.w * t);
  const double v = o.cosine * c + o.sine * s;
  value += v;
  out << c, s, t * (o.sine * c - o.cosine * s), -t * v;
}

struct Linear {
  Series left;
  Eigen::MatrixXd jacobian;
};

Linear linearised(const OscillationFit& fit, const Series& series, double dt) {
  Linear linear{series, Eigen::MatrixXd::Ones(series.size(), 1 + 4 * fit.modes.size())};
  for (Eigen::Index i = 0; i < series.size(); ++i) {
    double value = fit.constant;
    Eigen::RowVectorXd part(4);
    for (std::size_t m = 0; m < fit.modes.size(); ++m) {
      row_of(fit.modes[m], dt * i, value, part);
      linear.jacobian.block(i, 1 + 4 * m, 1, 4) = part;
    }
    linear.left[i] -= value;
  }
  return linear;
}

// Amplitudes for given frequencies and decays, which are linear.
bool start_amplitudes(OscillationFit& fit, const Series& series, double dt, const Noise& noise) {
  for (Oscillation& o : fit.modes) o.cosine = o.sine = 0.0;
  const Linear linear = linearised(fit, series, dt);
  const auto modes = static_cast<Eigen::Index>(fit.modes.size());
  Eigen::MatrixXd x(series.size(), 1 + 2 * modes);
  x.col(0).setOnes();
  for (Eigen::Index m = 0; m < modes; ++m)
    x.middleCols(1 + 2 * m, 2) = linear.jacobian.middleCols(1 + 4 * m, 2);
  Projection projection(static_cast<int>(x.cols()));
  projection.add(series, x, noise);
  Projection::Result result;
  if (!projection.solve(result)) return false;
  fit.constant = result.value[0];
  for (Eigen::Index m = 0; m < modes; ++m) {
    fit.modes[m].cosine = result.value[1 + 2 * m];
    fit.modes[m].sine = result.value[2 + 2 * m];
  }
  return true;
}

double cost_of(const Series& left, const Noise& noise) {
  double cost = 0.0;
  for (const double w : whiten(left, noise))
    if (std::isfinite(w)) cost += w * w;
  return cost;
}

// Moves by a share of a Gauss-Newton step, and by no more than a fifth of a frequency, which would
// leave the period it stands on. Returns the largest relative change of a frequency or decay.
double take_step(OscillationFit& fit, const Eigen::VectorXd& step, double share) {
  double change = 0.0;
  for (std::size_t m = 0; m < fit.modes.size(); ++m) {
    const double size = step.segment<2>(3 + 4 * m).norm() / fit.modes[m].w;
    share = std::min(share, 0.2 / std::max(size, 1e-300));
  }
  fit.constant += share * step[0];
  for (std::size_t m = 0; m < fit.modes.size(); ++m) {
    Oscillation& o = fit.modes[m];
    const Eigen::Vector4d s = share * step.segment<4>(1 + 4 * m);
    change = std::max(change, s.tail<2>().norm() / o.w);
    o.cosine += s[0];
    o.sine += s[1];
    o.w += s[2];
    o.decay += s[3];
  }
  return change;
}

bool plausible(const OscillationFit& fit) {
  return std::ranges::all_of(
      fit.modes, [](const Oscillation& o) { return o.w > 0.0 && std::abs(o.decay) < 2.0 * o.w; });
}

}  // namespace

double Oscillation::amplitude() const {
  return std::hypot(cosine, sine);
}
double Oscillation::frequency() const {
  return w / two_pi;
}
double Oscillation::damping_ratio() const {
  return decay / std::hypot(w, decay);
}

double OscillationFit::frequency_error(int mode) const {
  return std::sqrt(covariance(4 * mode + 3, 4 * mode + 3)) / two_pi;
}
// zeta = d / sqrt(w^2 + d^2), so dzeta = (w^2 dd - w d dw) / (w^2 + d^2)^(3/2).
double OscillationFit::damping_error(int mode) const {
  const Oscillation& o = modes[mode];
  const double cube = std::pow(std::hypot(o.w, o.decay), 3);
  const Eigen::Vector2d g(-o.w * o.decay / cube, o.w * o.w / cube);
  return std::sqrt(g.dot(covariance.block<2, 2>(4 * mode + 3, 4 * mode + 3) * g));
}
double OscillationFit::amplitude_error(int mode) const {
  const Oscillation& o = modes[mode];
  const Eigen::Vector2d g = Eigen::Vector2d(o.cosine, o.sine) / std::max(o.amplitude(), 1e-300);
  return std::sqrt(g.dot(covariance.block<2, 2>(4 * mode + 1, 4 * mode + 1) * g));
}

std::optional<OscillationFit> fit_oscillations(const Series& series, double dt, const Noise& noise,
                                               std::span<const Oscillation> start) {
  OscillationFit fit;
  fit.modes.assign(start.begin(), start.end());
  if (!start_amplitudes(fit, series, dt, noise)) return std::nullopt;
  for (int pass = 0; pass < passes; ++pass) {
    const Linear linear = linearised(fit, series, dt);
    Projection projection(static_cast<int>(linear.jacobian.cols()));
    projection.add(linear.left, linear.jacobian, noise);
    Projection::Result result;
    if (!projection.solve(result)) return std::nullopt;
    fit.covariance = result.covariance;
    fit.scatter = result.scatter;
    const double before = cost_of(linear.left, noise);
    const OscillationFit here = fit;
    double change = std::numeric_limits<double>::infinity();
    for (double share = 1.0; share > 1e-3; share *= 0.5) {
      fit = here;
      change = take_step(fit, result.value, share);
      if (cost_of(linearised(fit, series, dt).left, noise) <= before * (1.0 + 1e-12)) break;
    }
    if (!plausible(fit)) return std::nullopt;
    if (change < 1e-7) return fit;
  }
  return std::nullopt;
}

std::optional<Oscillation> main_oscillation(const Series& series, double dt) {
  double mean = 0.0;
  Eigen::Index n = 0;
  for (const double x : series)
    if (std::isfinite(x)) mean += x, ++n;
  if (n < 8) return std::nullopt;
  mean /= static_cast<double>(n);
  std::vector<double> crossings;
  for (Eigen::Index i = 1; i < series.size(); ++i) {
    const double a = series[i - 1] - mean, b = series[i] - mean;
    if (std::isfinite(a) && std::isfinite(b) && (a < 0.0) != (b < 0.0))
      crossings.push_back(dt * (i - b / (b - a)));
  }
  if (crossings.size() < 5) return std::nullopt;
  const double w = 0.5 * two_pi * (crossings.size() - 1.0) / (crossings.back() - crossings.front());
  return Oscillation{0.0, 0.0, w, 0.03 * w};
}

std::optional<Oscillation> higher_oscillation(const Series& left, double dt, double above_w) {
  const double length = dt * left.size(), step = 0.25 * two_pi / length;
  double best = 0.0, found = 0.0;
  for (double w = 1.8 * above_w; w < 0.8 * std::numbers::pi / dt; w += step) {
    std::complex<double> sum = 0.0;
    for (Eigen::Index i = 0; i < left.size(); ++i)
      if (std::isfinite(left[i])) sum += left[i] * std::polar(1.0, -w * dt * i);
    if (std::abs(sum) <= best) continue;
    best = std::abs(sum);
    found = w;
  }
  if (found == 0.0) return std::nullopt;
  return Oscillation{0.0, 0.0, found, 0.03 * found};
}

Series values_of(const OscillationFit& fit, Eigen::Index samples, double dt) {
  return -linearised(fit, Series::Zero(samples), dt).left;
}

}  // namespace pedicel::discrepancy
