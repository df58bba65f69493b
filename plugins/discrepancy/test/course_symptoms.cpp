// How what is seen depends on the rate and on what was before: stiffness at rest and swinging, the
// loop by rate, the delay by frequency, and what of a force lags or remembers.
#include <algorithm>
#include <cmath>
#include <optional>

#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

// A reading with a wide error is left out and not only given little weight: what makes it wide,
// such as a force that hardly changes, also makes it wrong.
constexpr double widest_error = 0.2;      // of a stiffness that still says something
constexpr double quiet_share = 0.25;      // of the swing's frequency: slower is as good as at rest
constexpr double least_rate_ratio = 1.5;  // between the slowest and the fastest
constexpr double longest_lag_error = 0.05;  // s
constexpr int least_force_samples = 16;

/// Readings of one number: their mean, its error widened where they scatter more.
/// Readings of different trials differ by more than noise where the model is wrong in another
/// respect. By Birge's ratio the error of the mean grows with that scatter, and never falls below
/// what noise gives.
std::optional<Measured> mean_of(const std::vector<Measured>& readings) {
  double weight = 0.0, sum = 0.0, chi = 0.0;
  for (const Measured& r : readings) {
    weight += 1.0 / (r.error * r.error);
    sum += r.value / (r.error * r.error);
  }
  // Infinite where an error was 0, which no reading has by right.
  if (!(weight > 0.0) || !std::isfinite(weight)) return std::nullopt;
  const double mean = sum / weight;
  for (const Measured& r : readings) chi += std::pow((r.value - mean) / r.error, 2);
  // One degree goes to the mean. Of one reading nothing is known of its scatter.
  const double free = std::max(1.0, static_cast<double>(readings.size()) - 1.0);
  return Measured{mean, std::sqrt(std::max(1.0, chi / free) / weight)};
}

/// A reading at a place of another number.
struct PlacedReading {
  double at;
  Measured reading;
};

/// What changes from the lowest place to the highest, along a straight line.
std::optional<Measured> change_along(const std::vector<PlacedReading>& all) {
  if (all.size() < 2) return std::nullopt;
  double w = 0.0, wx = 0.0, wy = 0.0, low = all[0].at, high = all[0].at;
  for (const PlacedReading& r : all) {
    const double weight = std::pow(r.reading.error, -2);
    // About the weighted centre: slope and level are then independent, and the variance of the
    // slope is 1 / xx.
    w += weight, wx += weight * r.at, wy += weight * r.reading.value;
    low = std::min(low, r.at), high = std::max(high, r.at);
  }
  double xx = 0.0, xy = 0.0, chi = 0.0;
  for (const PlacedReading& r : all) {
    const double weight = std::pow(r.reading.error, -2);
    xx += weight * std::pow(r.at - wx / w, 2);
    xy += weight * (r.at - wx / w) * (r.reading.value - wy / w);
  }
  if (!(xx > 0.0) || !std::isfinite(xx)) return std::nullopt;
  for (const PlacedReading& r : all)
    chi += std::pow((r.reading.value - wy / w - xy / xx * (r.at - wx / w)) / r.reading.error, 2);
  // Two readings lie on their line, whatever they are.
  const double scatter = all.size() > 2 ? chi / (static_cast<double>(all.size()) - 2.0) : 1.0;
  return Measured{(high - low) * xy / xx, (high - low) * std::sqrt(std::max(1.0, scatter) / xx)};
}

// Only where nothing moves the plant: while a path goes on, places follow the drive and not the
// load.
bool is_free(const SymptomContext& context, const StaticStretch& stretch) {
  const Trial& trial = context.trial(stretch.trial);
  const double at = trial.markers.time[stretch.from];
  return std::ranges::any_of(spans_of(trial), [at](const Span& span) {
    return span.free && at >= span.from - 1e-9 && at < span.to;
  });
}

/// How much more stiffly than the model's the plant stands under different loads, from where its
/// markers rest: the residual along the way that the model's go. A shape that is another one
/// throughout is a constant of each coordinate, and takes no part.
std::optional<Measured> stiffness_at_rest(const SymptomContext& context) {
  std::vector<StaticStretch> stretches = static_stretches(context);
  // What is compared are ways between stretches under different loads, so at least two of them are
  // needed, and the shape itself drops out.
  std::erase_if(stretches, [&](const StaticStretch& s) { return !is_free(context, s); });
  double xx = 0.0, xy = 0.0, yy = 0.0, free = 0.0;
  for (int c = 0; c < 3 * context.markers(); ++c) {
    double w = 0.0, wx = 0.0, wy = 0.0, count = 0.0;
    const auto each = [&](const auto& visit) {
      for (const StaticStretch& s : stretches)
        if (std::isfinite(s.mean[c]) && s.error[c] > 0.0)
          visit(std::pow(s.error[c], -2), s.position[c], s.mean[c]);
    };
    each([&](double weight, double x, double y) {
      w += weight, wx += weight * x, wy += weight * y, count += 1.0;
    });
    // A coordinate with its own constant needs two readings before it says anything.
    if (count < 2.0) continue;
    each([&](double weight, double x, double y) {
      xx += weight * std::pow(x - wx / w, 2);
      xy += weight * (x - wx / w) * (y - wy / w);
      yy += weight * std::pow(y - wy / w, 2);
    });
    // Each coordinate has spent one degree on its constant.
    free += count - 1.0;
  }
  // Of one degree nothing is left for the scatter.
  if (!(xx > 0.0) || free < 2.0) return std::nullopt;
  // Residual over way: the plant goes (1 + softer) times as far as the model, and is stiffer by the
  // inverse.
  const double softer = xy / xx;
  const double scatter = (yy - softer * xy) / (free - 1.0);
  const double error = std::sqrt(std::max(1.0, scatter) / xx);
  // A plant that would hardly move at all, or backwards, is no stiffer plant: something else is
  // wrong.
  if (error > widest_error || softer <= -1.0 + widest_error) return std::nullopt;
  return Measured{1.0 / (1.0 + softer) - 1.0, error / std::pow(1.0 + softer, 2)};
}

/// Hz, by which a path mostly goes: RMS speed over RMS way.
/// Of a sine this is its frequency, times 2 pi. No spectrum is needed for what only has to be slow.
double path_frequency(const DrivenPath& path, double until) {
  double ways = 0.0, speeds = 0.0;
  const double step = until / 400.0;
  for (double t = 0.0; t < until; t += step) {
    ways += (path.position_at(t) - path.position_at(0.0)).squaredNorm();
    speeds += (path.position_at(t + step) - path.position_at(t)).squaredNorm() / (step * step);
  }
  return ways > 0.0 ? std::sqrt(speeds / ways) / (2.0 * M_PI) : 0.0;
}

/// From the forces of pushes that are slow beside the swing.
void add_slow_pushes(const SymptomContext& context, const std::vector<Symptom>& found, double swing,
                     std::vector<Measured>& readings) {
  for (const Symptom& symptom : found) {
    // The symptoms that were found before are readings of this one: each has its error already.
    if (symptom.name != "force_scale" || !(symptom.standard_error > 0.0)) continue;
    for (int t = 0; t < context.trials(); ++t) {
      const Trial& trial = context.trial(t);
      if (trial.name != symptom.subject || trial.holds.empty()) continue;
      const Hold& hold = trial.holds.front();
      // At a quarter of the swing's frequency inertia takes a sixteenth of the stiffness, in the
      // model as well.
      if (path_frequency(hold.path, std::min(hold.release, trial.duration())) < quiet_share * swing)
        readings.push_back({0.01 * symptom.value, 0.01 * symptom.standard_error});
    }
  }
}

/// Hz, the lowest main frequency of the trials whose free swing was fitted.
double lowest_swing(const SymptomContext& context, const std::vector<Symptom>& found) {
  double lowest = 0.0;
  for (const TrialDelay& delay : trial_delays(context)) {
    const bool swings = std::ranges::any_of(found, [&](const Symptom& symptom) {
      return symptom.name == "frequency" && symptom.subject == context.trial(delay.trial).name;
    });
    // The lowest, so that a push counts as slow beside every swing that was seen.
    if (swings && delay.frequency > 0.0 && (lowest == 0.0 || delay.frequency < lowest))
      lowest = delay.frequency;
  }
  return lowest;
}

void add_stiffness_by_rate(const SymptomContext& context, std::vector<Symptom>& out) {
  std::vector<Measured> swinging, resting;
  for (const Symptom& symptom : out)
    if (symptom.name == "frequency" && symptom.standard_error > 0.0) {
      // Stiffness goes with the square of a frequency, so its error is twice the share's.
      const double share = 1.0 + 0.01 * symptom.value;
      swinging.push_back({share * share - 1.0, 0.02 * share * symptom.standard_error});
    }
  // Without a swing there is nothing to compare with rest.
  if (swinging.empty()) return;
  if (const auto rest = stiffness_at_rest(context)) resting.push_back(*rest);
  add_slow_pushes(context, out, lowest_swing(context, out), resting);
  // Both against the model, whose own law is the same at all rates: a modulus that is off cancels
  // in their ratio, and what depends on the rate stays.
  const auto dynamic = mean_of(swinging), still = mean_of(resting);
  if (!dynamic || !still || still->value <= -1.0) return;
  const double ratio = (1.0 + dynamic->value) / (1.0 + still->value);
  const double error = ratio * std::hypot(dynamic->error / (1.0 + dynamic->value),
                                          still->error / (1.0 + still->value));
  Symptom symptom = make_symptom("dynamic_over_static", "", 100.0 * (ratio - 1.0), 100.0 * error);
  symptom.unit = "%";
  symptom.least = 0.5;
  symptom.sentence = "Swinging, the plant is " + with_error(ratio, error, "1") +
                     " times as stiff as at rest, both against the model: " +
                     with_error(100.0 * dynamic->value, 100.0 * dynamic->error, "%") +
                     " stiffer than the model in its swings, " +
                     with_error(100.0 * still->value, 100.0 * still->error, "%") + " at rest.";
  out.push_back(std::move(symptom));
}

/// m, way of the held point until it is let go.
/// The whole way there and back, as the loop's energy was spent on it.
double length_of_path(const Trial& trial) {
  const Hold& hold = trial.holds.front();
  double length = 0.0;
  for (int i = 1; i < trial.force.size() && trial.force.time[i] < hold.release - 1e-9; ++i)
    length += (hold.path.position_at(trial.force.time[i]) -
               hold.path.position_at(trial.force.time[i - 1]))
                  .norm();
  return length;
}

// A loop's energy over force and way is the same at any rate for friction, and grows with the rate
// for a viscous force.
void add_loop_by_rate(const SymptomContext& context, std::vector<Symptom>& out) {
  std::vector<PlacedReading> readings;
  for (const Symptom& symptom : out) {
    if (symptom.name != "loop_area" || !(symptom.standard_error > 0.0)) continue;
    for (int t = 0; t < context.trials(); ++t) {
      const Trial& trial = context.trial(t);
      if (trial.name != symptom.subject) continue;
      const double way = length_of_path(trial);
      const double most = context.predictions[t].force.rowwise().norm().maxCoeff();
      const double last = std::min(trial.holds.front().release, trial.force.time.back());
      const double length = last - trial.force.time.front();
      if (!(way * most > 0.0) || !(length > 0.0)) continue;
      // Over force times way: a long push costs more than a short one at any rate, and only the
      // share can be compared.
      const double share = 0.1 / (way * most);  // % from mJ
      // Against the logarithm of the speed: rates of pushes lie decades apart.
      readings.push_back(
          {std::log10(way / length), {share * symptom.value, share * symptom.standard_error}});
    }
  }
  if (readings.size() < 2) return;
  const auto [slow, fast] = std::ranges::minmax(readings, {}, &PlacedReading::at);
  // Of pushes at about one rate a slope would be made of noise alone.
  if (fast.at - slow.at < std::log10(least_rate_ratio)) return;
  const auto change = change_along(readings);
  if (!change) return;
  Symptom symptom = make_symptom("loop_area_by_rate", "", change->value, change->error);
  symptom.unit = "%";
  symptom.least = 0.2;
  symptom.sentence = "From " + short_number(1e3 * std::pow(10.0, slow.at)) + " to " +
                     short_number(1e3 * std::pow(10.0, fast.at)) +
                     " mm/s the energy that pushes cost changes by " +
                     with_error(change->value, change->error, "%") +
                     " of force times way beyond the model's; friction does not change it, "
                     "viscosity makes it grow.";
  out.push_back(std::move(symptom));
}

// A pure delay is the same at all frequencies; what filters or dissipates is not.
void add_delay_by_frequency(const SymptomContext& context, std::vector<Symptom>& out) {
  std::vector<PlacedReading> readings;
  for (const TrialDelay& one : trial_delays(context))
    if (one.frequency > 0.0 && one.delay.error > 0.0)
      readings.push_back({one.frequency, {1e3 * one.delay.value, 1e3 * one.delay.error}});
  if (readings.size() < 2) return;
  const auto [slow, fast] = std::ranges::minmax(readings, {}, &PlacedReading::at);
  // The same holds for frequencies.
  if (!(fast.at > least_rate_ratio * slow.at)) return;
  const auto change = change_along(readings);
  if (!change) return;
  Symptom symptom = make_symptom("delay_by_frequency", "", change->value, change->error);
  symptom.unit = "ms";
  symptom.least = 0.2;
  symptom.sentence = "From trials at " + short_number(slow.at) + " Hz to those at " +
                     short_number(fast.at) + " Hz the markers' delay changes by " +
                     with_error(change->value, change->error, "ms") +
                     "; a delay of the instrument alone stays the same.";
  out.push_back(std::move(symptom));
}

/// The force of a trial while its first hold holds: the predicted one, its rate, and what its own
/// past keeps of it.
struct ForceHistory {
  Eigen::MatrixXd residual, now, rate, past;
  double memory = 0.0;  ///< s
};

std::optional<ForceHistory> force_history(const SymptomContext& context, int t) {
  const Trial& trial = context.trial(t);
  const Eigen::MatrixXd& predicted = context.predictions[t].force;
  if (trial.holds.empty() || !context.predictions[t].healthy || predicted.cols() != 3 ||
      predicted.rows() != trial.force.value.rows() || !predicted.allFinite())
    return std::nullopt;
  const std::vector<double>& time = trial.force.time;
  Eigen::Index n = 0;
  while (n < predicted.rows() && time[n] < trial.holds.front().release - 1e-9) ++n;
  // Three regressors and a constant need more samples than that by far.
  if (n < least_force_samples || !(time[n - 1] > time[0])) return std::nullopt;
  ForceHistory force;
  force.now = predicted.topRows(n);
  force.residual = trial.force.value.topRows(n) - force.now;
  force.rate = force.past = Eigen::MatrixXd::Zero(n, 3);
  // Between the shortest and the longest that the record can tell.
  const double length = time[n - 1] - time[0];
  // The geometric mean of the sampling interval and the length of the push: a memory nearer to
  // either passes for a lag or for a scale.
  force.memory = std::sqrt(length * length / static_cast<double>(n - 1));
  // As if the force had always been what it is at first: the push begins from rest.
  force.past.row(0) = force.now.row(0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = std::max<Eigen::Index>(i - 1, 0), b = std::min(i + 1, n - 1);
    force.rate.row(i) = (force.now.row(b) - force.now.row(a)) / (time[b] - time[a]);
    if (i == 0) continue;
    // By the time between samples, which need not be even.
    const double kept = std::exp(-(time[i] - time[i - 1]) / force.memory);
    force.past.row(i) = kept * force.past.row(i - 1) + (1.0 - kept) * force.now.row(i);
  }
  return force;
}

// residual = -lag dF/dt + scale F + memory (past F - F) + a constant, all together, so that none
// passes for another.
void add_force_history(const SymptomContext& context, int t, std::vector<Symptom>& out) {
  const auto force = force_history(context, t);
  if (!force) return;
  Projection projection(3);
  for (int c = 0; c < 3; ++c) {
    Eigen::MatrixXd x(force->now.rows(), 3);
    // A lag l makes F(t - l), to first order F - l dF/dt. The scale is there to be taken out and is
    // told elsewhere.
    x << -force->rate.col(c), force->now.col(c), force->past.col(c) - force->now.col(c);
    projection.add(force->residual.col(c), x, context.data.force_noise(),
                   Projection::Constant::free);
  }
  Projection::Result result;
  if (!projection.solve(result)) return;
  const std::string& trial = context.trial(t).name;
  const Measured lag = result.component(0), memory = result.component(2);
  // Each of the two where the push tells it: a slow one says nothing of lags, a short one nothing
  // of memory.
  if (lag.error < longest_lag_error) {
    Symptom symptom = make_symptom("force_lag", trial, 1e3 * lag.value, 1e3 * lag.error);
    symptom.unit = "ms";
    symptom.least = 0.5;
    symptom.sentence = "The force in " + named_trial(trial) + " runs " +
                       with_error(std::abs(symptom.value), symptom.standard_error, "ms") +
                       (symptom.value < 0.0 ? " ahead of" : " behind") + " the model's.";
    out.push_back(std::move(symptom));
  }
  if (memory.error < widest_error) {
    Symptom symptom =
        make_symptom("drive_history", trial, 100.0 * memory.value, 100.0 * memory.error);
    symptom.unit = "%";
    symptom.least = 0.5;
    symptom.sentence = "Of the force in " + named_trial(trial) + " " +
                       with_error(symptom.value, symptom.standard_error, "%") +
                       " goes by where the drive was in the " + short_number(force->memory) +
                       " s before, beyond the model.";
    out.push_back(std::move(symptom));
  }
}

}  // namespace

void add_course_symptoms(const SymptomContext& context, std::vector<Symptom>& out) {
  // These read what was found before, so this file's finders come last of all.
  add_stiffness_by_rate(context, out);
  add_loop_by_rate(context, out);
  add_delay_by_frequency(context, out);
  for (int t = 0; t < context.trials(); ++t)
    if (context.trial(t).force.size() > 0) add_force_history(context, t, out);
}

}  // namespace pedicel::discrepancy
