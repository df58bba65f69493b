#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

// Markers that move less than this many noise units say nothing about times or planes.
constexpr double least_motion = 10.0;

// Beside a constant of every channel, a delay d makes a residual -d v; a frequency that is off by
// the share e makes one of e t v, t from the last jump. Both together, so that neither passes for
// the other.
// First order in both: measured(t) = model(t - d), and of a frequency (1 + e) f it is model(t + e
// t).
Eigen::MatrixXd delay_regressors(const std::vector<double>& time, const std::vector<Span>& spans,
                                 const Eigen::VectorXd& v) {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(v.size(), 2);
  std::size_t s = 0;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    // Phase is made from the last jump on, where the plant was let go. Before it the drive leads,
    // and its times are right.
    while (s + 1 < spans.size() && time[i] >= spans[s].to - 1e-9) ++s;
    x(i, 0) = -v[i];
    // Only where the plant is free has it a frequency of its own.
    if (s < spans.size() && spans[s].free) x(i, 1) = (time[i] - spans[s].from) * v[i];
  }
  return x;
}

void add_delays(const SymptomContext& context, int t, Projection& one, Projection* all) {
  const Eigen::MatrixXd v = context.velocity(t);
  const auto spans = spans_of(context.trial(t));
  for (int c = 0; c < v.cols(); ++c) {
    const Eigen::MatrixXd x = delay_regressors(context.trial(t).markers.time, spans, v.col(c));
    one.add(context.residual(t, c), x, context.data.position_noise(), Projection::Constant::free);
    // One trial for itself, and all together: a delay of the instrument is the same in all of them.
    if (all)
      all->add(context.residual(t, c), x, context.data.position_noise(),
               Projection::Constant::free);
  }
}

// Hz, by which the motion of a trial mostly goes: rms acceleration over rms velocity.
double main_frequency(const Eigen::MatrixXd& v, const std::vector<double>& time) {
  double rate = 0.0, change = 0.0;
  for (Eigen::Index i = 1; i < v.rows(); ++i) {
    const double dt = time[i] - time[i - 1];
    if (!(dt > 0.0)) continue;
    // Of a sine the acceleration is 2 pi f times the velocity. It needs no period to be whole and
    // no record to be even.
    change += (v.row(i) - v.row(i - 1)).squaredNorm() / (dt * dt);
    rate += v.row(i).squaredNorm();
  }
  return rate > 0.0 ? std::sqrt(change / rate) / (2.0 * std::numbers::pi) : 0.0;
}

// A trial without free motion leaves the share e open; then the delay stands alone.
bool solve_delay(const SymptomContext& context, int t, Measured& delay) {
  // Two unknowns, and a constant of each channel that the projection takes out by itself.
  Projection both(2);
  add_delays(context, t, both, nullptr);
  Projection::Result result;
  // The delay beside a frequency that is off: both shift a swing, but only the frequency's shift
  // grows.
  if (both.solve(result)) {
    delay = result.component(0);
    return true;
  }
  Projection alone(1);
  const Eigen::MatrixXd v = context.velocity(t);
  for (int c = 0; c < v.cols(); ++c)
    alone.add(context.residual(t, c), -v.col(c), context.data.position_noise(),
              Projection::Constant::free);
  if (!alone.solve(result)) return false;
  delay = result.component(0);
  return true;
}

void add_time_shift(const SymptomContext& context, std::vector<Symptom>& out) {
  Projection all(2);
  SymptomPlot plot{"Delay of the markers behind the model, by trial",
                   "main frequency of the trial (Hz)",
                   "delay (ms)",
                   {{"trials", {}, {}, false}, {"95 % interval", {}, {}}}};
  for (int t = 0; t < context.trials(); ++t) {
    if (!context.usable(t)) continue;
    // Its result is not used here. trial_delays() solves each trial again, where one without free
    // motion must be told apart.
    Projection one(2);
    add_delays(context, t, one, &all);
  }
  for (const auto& [t, f, delay] : trial_delays(context)) {
    plot.series[0].x.push_back(f);
    plot.series[0].y.push_back(1e3 * delay.value);
    // The NaN ends each bar, so that one series draws them all.
    for (const double side : {-1.96, 1.96, std::numeric_limits<double>::quiet_NaN()}) {
      plot.series[1].x.push_back(f);
      plot.series[1].y.push_back(1e3 * (delay.value + side * delay.error));
    }
  }
  Projection::Result result;
  if (!all.solve(result)) {
    // No trial swings freely.
    // Then no frequency is there to be off, and nothing can pass for a delay.
    Projection alone(1);
    for (int t = 0; t < context.trials(); ++t) {
      if (!context.usable(t)) continue;
      const Eigen::MatrixXd v = context.velocity(t);
      for (int c = 0; c < v.cols(); ++c)
        alone.add(context.residual(t, c), -v.col(c), context.data.position_noise(),
                  Projection::Constant::free);
    }
    if (!alone.solve(result)) return;
  }
  const Measured delay = result.component(0);
  // A delay is seen by motion alone. Of a plant at rest any number would do.
  if (delay.error > 0.05) return;  // s: nothing moves
  Symptom symptom = make_symptom("time_shift", "", 1e3 * delay.value, 1e3 * delay.error);
  symptom.unit = "ms";
  // In ms: a fortieth of a step of 1/240 s.
  symptom.least = 0.1;
  // With the share of the residual: a delay that explains little is real, and not what is wrong.
  symptom.sentence = "The markers run " +
                     with_error(std::abs(symptom.value), symptom.standard_error, "ms") +
                     (symptom.value < 0.0 ? " ahead of" : " behind") +
                     " the model in all trials together; that explains " +
                     short_number(100.0 * result.explained) + " % of the residual.";
  symptom.plot = plot;
  out.push_back(std::move(symptom));
}

/// Plane in which a trial's plant moves: the main horizontal direction of the predicted motion.
/// The predicted one, since the measured motion is what is judged.
struct Plane {
  Vec3 along = Vec3::Zero(), across = Vec3::Zero();
  double motion = 0.0;  // m, RMS over the markers
};

Plane plane_of(const Eigen::MatrixXd& markers) {
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  const Eigen::RowVectorXd mean = markers.colwise().mean();
  for (Eigen::Index c = 0; c + 2 < markers.cols(); c += 3) {
    // About each marker's own mean, so that where it hangs does not count. Heights are left out: a
    // stem that bends moves down in any direction.
    const Eigen::MatrixXd d = markers.middleCols(c, 2).rowwise() - mean.segment<2>(c);
    spread += d.transpose() * d;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(spread);
  Plane plane;
  plane.along << eigen.eigenvectors().col(1), 0.0;
  // Horizontal, too: a sag is no motion across the plane of a push.
  plane.across = Vec3::UnitZ().cross(plane.along);
  const double count = static_cast<double>(markers.rows() * (markers.cols() / 3));
  plane.motion = std::sqrt(eigen.eigenvalues()[1] / count);
  return plane;
}

// Samples that count as independent in a mean square of noise with such a correlation.
// Of a mean square it is the sum of the squared correlations, and of a mean it would be that of the
// correlations themselves (Bartlett).
double independent(double samples, const Noise& noise) {
  double sum = 1.0;
  const std::vector<double> rho = autocorrelation(noise, 100);
  for (std::size_t k = 1; k < rho.size(); ++k) sum += 2.0 * rho[k] * rho[k];
  return samples / sum;
}

void add_out_of_plane(const SymptomContext& context, int t, std::vector<Symptom>& out) {
  const Eigen::MatrixXd& predicted = context.predictions[t].markers;
  const Plane plane = plane_of(predicted);
  const Noise& noise = context.data.position_noise();
  // A share of a motion that is not there is nothing.
  if (plane.motion < least_motion * noise.std) return;
  double squares = 0.0, count = 0.0;
  for (int m = 0; m < context.markers(); ++m) {
    const Series r = plane.across.x() * context.residual(t, 3 * m) +
                     plane.across.y() * context.residual(t, 3 * m + 1);
    // A constant is no motion.
    double mean = 0.0, n = 0.0;
    // Gaps are NaN, and left out of both passes.
    for (const double x : r)
      if (std::isfinite(x)) mean += x, n += 1.0;
    if (n < 8.0) continue;
    mean /= n;
    for (const double x : r)
      if (std::isfinite(x)) squares += (x - mean) * (x - mean);
    // Taking off the mean costs what one independent sample is worth.
    count += n - n / independent(n, noise);
  }
  if (count < 8.0) return;
  // Less than the noise is only chance.
  // Squares, and not amplitudes: noise adds in squares, and can be taken off.
  const double excess = std::max(0.0, squares / count - noise.std * noise.std);
  const double error = noise.std * noise.std * std::sqrt(2.0 / independent(count, noise)) /
                       std::pow(plane.motion, 2);
  Symptom symptom = make_symptom("out_of_plane", context.trial(t).name,
                                 excess / std::pow(plane.motion, 2), error);
  symptom.unit = "1";
  // Of the squared motion. A plane that is off by little more than a degree shows as much.
  symptom.least = 4.0e-4;  // 2 % of the amplitude
  symptom.sentence = "In " + named_trial(context.trial(t).name) +
                     " the plant moves across the plane of the "
                     "push by " +
                     short_number(100.0 * std::sqrt(symptom.value)) +
                     " % of its motion in it, otherwise than the model (share of the squared "
                     "motion: " +
                     with_error(symptom.value, error, "1") + ").";
  out.push_back(std::move(symptom));
}

}  // namespace

std::vector<TrialDelay> trial_delays(const SymptomContext& context) {
  // The same bound as for all trials together.
  constexpr double widest = 0.05;  // s, error of a trial in which hardly anything moves
  std::vector<TrialDelay> delays;
  for (int t = 0; t < context.trials(); ++t) {
    TrialDelay one;
    one.trial = t;
    // Others ask for delays by trial, too, so that this list is made in one place.
    if (!context.usable(t) || !solve_delay(context, t, one.delay) || one.delay.error > widest)
      continue;
    one.frequency = main_frequency(context.velocity(t), context.trial(t).markers.time);
    delays.push_back(one);
  }
  return delays;
}

void add_motion_symptoms(const SymptomContext& context, std::vector<Symptom>& out) {
  add_time_shift(context, out);
  for (int t = 0; t < context.trials(); ++t)
    if (context.usable(t)) add_out_of_plane(context, t, out);
}

}  // namespace pedicel::discrepancy
