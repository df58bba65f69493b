#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/simulate/noise.h"
#include "plugins/discrepancy/simulate/trial_member.h"

namespace pedicel::discrepancy {

namespace {

constexpr int most_modes = 8;
constexpr double samples_a_number = 3.0;  // at least, in the window
constexpr double samples_a_period = 5.0;  // likewise, of the fastest mode
constexpr double most_decay = 0.7;        // of the frequency: damped more, a mode does not swing
constexpr double one_frequency = 1.05;    // of two modes, as of a round stem's two directions
constexpr double known_better = 0.5;      // an amplitude's deviation, of what it is likely to be

// Half the way that a marker's axis goes, at most.
double motion_of(const Samples& markers) {
  double most = 0.0;
  for (Eigen::Index c = 0; c < markers.value.cols(); ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double x : markers.value.col(c))
      if (std::isfinite(x)) {
        low = std::min(low, x);
        high = std::max(high, x);
      }
    if (high > low) most = std::max(most, 0.5 * (high - low));
  }
  return most;
}

double noise_of(const Experiment& experiment, const Samples& markers) {
  if (experiment.noise.position_std) return *experiment.noise.position_std;
  std::vector<Series> channels;
  for (Eigen::Index c = 0; c < markers.value.cols(); ++c)
    channels.emplace_back(markers.value.col(c));
  return estimate_noise(channels, 0.0).std;
}

/// The window's samples, and which of them hold something.
struct FirstSamples {
  std::vector<double> time;  // s
  Eigen::VectorXd there;     // 1 or 0, by sample, then marker, then axis
  int samples = 0, axes = 0;

  FirstSamples(const Samples& markers, double length) {
    const auto end = std::upper_bound(markers.time.begin(), markers.time.end(), length + 1.0e-9);
    time.assign(markers.time.begin(), end);
    const Eigen::Index rows = static_cast<Eigen::Index>(time.size()), n = markers.value.cols();
    there.setZero(rows * n);
    for (Eigen::Index c = 0; c < n; ++c) {
      int seen = 0;
      for (Eigen::Index r = 0; r < rows; ++r)
        if (std::isfinite(markers.value(r, c))) {
          there[r * n + c] = 1.0;
          ++seen;
        }
      samples += seen;
      axes += seen > 2 ? 1 : 0;
    }
  }
  double step() const {
    return time.size() < 2 ? 0.0
                           : (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  }
};

Modes first_of(const Modes& modes, int count) {
  return {modes.shape.leftCols(count), modes.frequency.head(count), modes.decay.head(count)};
}

// Whether each amplitude of so many modes is known better from the window than beforehand.
bool tells(const StartPlan& plan, const Modes& modes, const cosserat::RodModel& model,
           std::span<const plant::PlacedPoint> markers, const FirstSamples& window) {
  const Eigen::MatrixXd swings =
      window.there.asDiagonal() * marker_swings(model, modes, markers, window.time);
  Eigen::MatrixXd information =
      swings.transpose() * swings / std::max(plan.noise * plan.noise, 1.0e-300);
  const Eigen::Index n = information.rows();
  Eigen::VectorXd likely(n);
  for (Eigen::Index i = 0; i < n; ++i)
    likely[i] = likely_amplitude(plan, modes, static_cast<int>(i) % modes.size());
  information.diagonal() += likely.cwiseAbs2().cwiseInverse();
  const Eigen::MatrixXd covariance = information.inverse();
  return (covariance.diagonal().array().sqrt() < known_better * likely.array()).all();
}

}  // namespace

StartPlan plan_start(const PlantMaker& maker, const Experiment& experiment, int trial) {
  const Trial& one = experiment.trials[trial];
  StartPlan plan;
  if (!one.window || one.is_static) return plan;
  plan.window = *one.window;
  plan.motion = std::max(motion_of(one.markers), 1.0e-9);
  plan.noise = noise_of(experiment, one.markers);
  const FirstSamples window(one.markers, plan.window);
  RunMember nominal;
  nominal.effects = experiment.effects;
  nominal.effects.insert(nominal.effects.end(), one.effects.begin(), one.effects.end());
  TrialMember member(maker, experiment, one, nominal, 0);
  if (!member.settle()) return plan;
  const Modes modes = member.modes(most_modes + 1);
  std::vector<plant::PlacedPoint> markers;
  for (const Marker& marker : experiment.markers) markers.push_back(maker.locate(marker.place));
  for (int count = 1; count <= std::min(most_modes, modes.size()); ++count) {
    const double frequency = modes.frequency[count - 1];
    if (count > window.axes || samples_a_number * 2.0 * count > window.samples) break;
    if (frequency * window.step() * samples_a_period > 2.0 * M_PI && count > 1) break;
    if (modes.decay[count - 1] > most_decay * frequency && count > 1) break;
    if (count < modes.size() && modes.frequency[count] < one_frequency * frequency &&
        count < window.axes)
      continue;
    if (!tells(plan, first_of(modes, count), member.model(), markers, window) && plan.modes > 0)
      break;
    plan.modes = count;
  }
  return plan;
}

std::vector<StartPlan> plan_starts(const Experiment& experiment, double junction) {
  std::vector<StartPlan> starts(experiment.trials.size());
  const auto moves = [](const Trial& trial) { return trial.window.has_value(); };
  if (std::ranges::none_of(experiment.trials, moves)) return starts;
  const double distance = experiment.plant().distance;
  const PlantMaker maker(experiment, distance, junction * distance);
  for (std::size_t t = 0; t < starts.size(); ++t)
    starts[t] = plan_start(maker, experiment, static_cast<int>(t));
  return starts;
}

}  // namespace pedicel::discrepancy
