#include "plugins/discrepancy/test/oscillation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace pedicel::discrepancy {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
// Far more than a fit from a good start takes. Where thirty do not do, the record has no such
// oscillation.
constexpr int passes = 30;

// Values and derivatives at one time.
// Cosine and sine in place of amplitude and phase: the model is then linear in them, and a phase
// has no jump at 2 pi.
void row_of(const Oscillation& o, double t, double& value, Eigen::Ref<Eigen::RowVectorXd> out) {
  const double e = std::exp(-o.decay * t), c = e * std::cos(o.w * t), s = e * std::sin(o.w * t);
  const double v = o.cosine * c + o.sine * s;
  value += v;
  // By cosine, sine, w and decay. Those of w and decay grow with time, which is why long records
  // tell frequencies so well.
  out << c, s, t * (o.sine * c - o.cosine * s), -t * v;
}

struct Linear {
  Series left;
  Eigen::MatrixXd jacobian;
};

Linear linearised(const OscillationFit& fit, const Series& series, double dt) {
  // The first column stays 1: where the plant comes to rest is not known beforehand.
  Linear linear{series, Eigen::MatrixXd::Ones(series.size(), 1 + 4 * fit.modes.size())};
  for (Eigen::Index i = 0; i < series.size(); ++i) {
    double value = fit.constant;
    Eigen::RowVectorXd part(4);
    // All modes at once: one after the other they would take what belongs to their neighbours.
    for (std::size_t m = 0; m < fit.modes.size(); ++m) {
      row_of(fit.modes[m], dt * i, value, part);
      linear.jacobian.block(i, 1 + 4 * m, 1, 4) = part;
    }
    linear.left[i] -= value;
  }
  return linear;
}

// Amplitudes for given frequencies and decays, which are linear.
// The start of a separable problem: a wrong amplitude would send the first step of the frequency
// anywhere.
bool start_amplitudes(OscillationFit& fit, const Series& series, double dt, const Noise& noise) {
  // With no amplitude the value is zero, and what is left is the series itself.
  for (Oscillation& o : fit.modes) o.cosine = o.sine = 0.0;
  const Linear linear = linearised(fit, series, dt);
  const auto modes = static_cast<Eigen::Index>(fit.modes.size());
  Eigen::MatrixXd x(series.size(), 1 + 2 * modes);
  x.col(0).setOnes();
  for (Eigen::Index m = 0; m < modes; ++m)
    x.middleCols(1 + 2 * m, 2) = linear.jacobian.middleCols(1 + 4 * m, 2);
  Projection projection(static_cast<int>(x.cols()));
  // Whitened, as every fit here: noise with a memory would else count many times.
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
  // Gaps are NaN in the innovations, too.
  for (const double w : whiten(left, noise))
    if (std::isfinite(w)) cost += w * w;
  return cost;
}

// Moves by a share of a Gauss-Newton step, and by no more than a fifth of a frequency, which would
// leave the period it stands on. Returns the largest relative change of a frequency or decay.
// Least squares of a frequency has a valley a period wide, and many beside it.
double take_step(OscillationFit& fit, const Eigen::VectorXd& step, double share) {
  double change = 0.0;
  for (std::size_t m = 0; m < fit.modes.size(); ++m) {
    const double size = step.segment<2>(3 + 4 * m).norm() / fit.modes[m].w;
    // The smallest share over all modes, so that the step keeps its direction.
    share = std::min(share, 0.2 / std::max(size, 1e-300));
  }
  fit.constant += share * step[0];
  for (std::size_t m = 0; m < fit.modes.size(); ++m) {
    Oscillation& o = fit.modes[m];
    const Eigen::Vector4d s = share * step.segment<4>(1 + 4 * m);
    // Relative: frequencies of plants reach from a tenth to tens of Hz.
    change = std::max(change, s.tail<2>().norm() / o.w);
    o.cosine += s[0];
    o.sine += s[1];
    o.w += s[2];
    o.decay += s[3];
  }
  return change;
}

bool plausible(const OscillationFit& fit) {
  // What decays or grows as fast as that is no oscillation.
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
// w is the damped frequency: the undamped one is sqrt(w^2 + d^2).
double OscillationFit::damping_error(int mode) const {
  const Oscillation& o = modes[mode];
  const double cube = std::pow(std::hypot(o.w, o.decay), 3);
  const Eigen::Vector2d g(-o.w * o.decay / cube, o.w * o.w / cube);
  return std::sqrt(g.dot(covariance.block<2, 2>(4 * mode + 3, 4 * mode + 3) * g));
}
double OscillationFit::amplitude_error(int mode) const {
  const Oscillation& o = modes[mode];
  // The direction in which the amplitude grows: the error across it is one of the phase.
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
    // Of the last pass: it is made where the fit ends.
    fit.covariance = result.covariance;
    fit.scatter = result.scatter;
    const double before = cost_of(linear.left, noise);
    const OscillationFit here = fit;
    double change = std::numeric_limits<double>::infinity();
    // Halved until the cost falls. A full step from a frequency that is off may land in the next
    // valley.
    for (double share = 1.0; share > 1e-3; share *= 0.5) {
      fit = here;
      change = take_step(fit, result.value, share);
      if (cost_of(linearised(fit, series, dt).left, noise) <= before * (1.0 + 1e-12)) break;
    }
    if (!plausible(fit)) return std::nullopt;
    // Far below any error of a frequency, and above rounding.
    if (change < 1e-7) return fit;
  }
  return std::nullopt;
}

std::optional<Oscillation> main_oscillation(const Series& series, double dt) {
  double mean = 0.0;
  Eigen::Index n = 0;
  for (const double x : series)
    if (std::isfinite(x)) mean += x, ++n;
  // Fewer samples make no mean to cross.
  if (n < 8) return std::nullopt;
  // Crossings of the mean: the plant swings about where it comes to rest, which is seldom zero.
  mean /= static_cast<double>(n);
  std::vector<double> crossings;
  for (Eigen::Index i = 1; i < series.size(); ++i) {
    const double a = series[i - 1] - mean, b = series[i] - mean;
    // Between the two samples along a straight line, so that a coarse record has no worse guess.
    if (std::isfinite(a) && std::isfinite(b) && (a < 0.0) != (b < 0.0))
      crossings.push_back(dt * (i - b / (b - a)));
  }
  // Four half periods. Of fewer, noise about the mean would make a frequency.
  if (crossings.size() < 5) return std::nullopt;
  const double w = 0.5 * two_pi * (crossings.size() - 1.0) / (crossings.back() - crossings.front());
  // A damping ratio of 3 %, in the middle of what stems have. The fit finds its own.
  return Oscillation{0.0, 0.0, w, 0.03 * w};
}

std::optional<Oscillation> higher_oscillation(const Series& left, double dt, double above_w) {
  // A record of this length parts frequencies by 1/length. A quarter of that cannot step over a
  // peak.
  const double length = dt * left.size(), step = 0.25 * two_pi / length;
  // Of a record that is zero everywhere no frequency is found.
  double best = 0.0, found = 0.0;
  // From 1.8 times on, since what the first mode leaves stands beside it; up to below half of the
  // sampling rate, beyond which it is another frequency's image.
  for (double w = 1.8 * above_w; w < 0.8 * std::numbers::pi / dt; w += step) {
    std::complex<double> sum = 0.0;
    // A sum and no FFT: gaps are simply left out.
    for (Eigen::Index i = 0; i < left.size(); ++i)
      if (std::isfinite(left[i])) sum += left[i] * std::polar(1.0, -w * dt * i);
    if (std::abs(sum) <= best) continue;
    // The largest peak, whatever its width. Whether it stands out is for the fit to say.
    best = std::abs(sum);
    found = w;
  }
  if (found == 0.0) return std::nullopt;
  return Oscillation{0.0, 0.0, found, 0.03 * found};
}

Series values_of(const OscillationFit& fit, Eigen::Index samples, double dt) {
  // What is left of nothing is minus the fit.
  return -linearised(fit, Series::Zero(samples), dt).left;
}

}  // namespace pedicel::discrepancy
