#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/test/oscillation.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr int least_samples = 16;
constexpr double least_periods = 2.5;     // of a half record, for its own frequency
constexpr double least_amplitude = 10.0;  // noise units in all, of a mode that counts as seen
constexpr double worst_damping = 0.3;     // error of a damping ratio that still says something

/// One channel of a trial while the plant swings freely.
struct FreeSwing {
  int trial = 0, column = 0;
  double dt = 0.0;
  Series measured, simulated;  // m; NaN at the same samples
};

// The channel that swings most of the trial's longest free stretch that is evenly sampled.
// One channel is enough: all markers swing at the plant's own frequencies, and the one that swings
// most tells them best.
std::optional<FreeSwing> free_swing(const SymptomContext& context, int t) {
  const Trial& trial = context.trial(t);
  const std::vector<double>& time = trial.markers.time;
  const Eigen::MatrixXd& predicted = context.predictions[t].markers;
  FreeSwing best;
  double most = 0.0;
  for (const Span& span : spans_of(trial)) {
    if (!span.free) continue;
    // After the jump itself, whose sample may be of either side.
    const auto from = std::ranges::lower_bound(time, span.from + 1e-9) - time.begin();
    const auto to = std::ranges::lower_bound(time, span.to - 1e-9) - time.begin();
    const auto n = to - from;
    if (n < least_samples) continue;
    const double dt = (time[to - 1] - time[from]) / static_cast<double>(n - 1);
    bool even = true;
    // A fit of oscillations counts samples and not seconds, and so does the filter of the noise.
    // Two per cent are let pass, as time stamps are rounded.
    for (auto i = from + 1; i < to; ++i)
      even = even && std::abs(time[i] - time[i - 1] - dt) < 0.02 * dt;
    if (!even) continue;
    for (int c = 0; c < predicted.cols(); ++c) {
      Series measured = trial.markers.value.col(c).segment(from, n);
      Series simulated = predicted.col(c).segment(from, n);
      const double spread = (simulated.array() - simulated.mean()).matrix().squaredNorm();
      const auto missing = std::ranges::count_if(measured, [](double x) { return std::isnan(x); });
      // By the simulated motion, since a marker that was measured wrongly may scatter most.
      if (spread <= most || missing > n / 4) continue;
      most = spread;
      // Gaps on both sides: what a fit gets wrong because of a gap is then the same for both, and
      // cancels in the difference.
      for (Eigen::Index i = 0; i < n; ++i)
        if (std::isnan(measured[i])) simulated[i] = measured[i];
      best = {t, c, dt, std::move(measured), std::move(simulated)};
    }
  }
  if (most == 0.0) return std::nullopt;
  return best;
}

/// The same fit of both sides.
/// Never the model's own modes against a fit: both are fits to the same samples by the same code.
struct Pair {
  OscillationFit measured, simulated;
};

// Whether a mode is there, over the record as a whole: an amplitude at its start alone may be an
// extrapolation of nothing.
bool stands_out(const OscillationFit& fit, int mode, const FreeSwing& swing, const Noise& noise) {
  // One mode over the whole record, as it stands beside the others in the fit.
  OscillationFit alone;
  alone.modes = {fit.modes[mode]};
  const Series values = values_of(alone, swing.measured.size(), swing.dt);
  // Three conditions. In all it is beyond noise, at its largest it is more than one sample's noise,
  // and it swings at all.
  return values.norm() > least_amplitude * noise.std &&
         values.lpNorm<Eigen::Infinity>() > noise.std && fit.modes[mode].damping_ratio() < 0.5;
}

std::optional<Pair> fit_both(const FreeSwing& swing, const Noise& noise,
                             std::span<const Oscillation> start) {
  // The simulated side first, which has no noise: from there the measured one starts in the right
  // valley.
  const auto simulated = fit_oscillations(swing.simulated, swing.dt, noise, start);
  if (!simulated) return std::nullopt;
  // With the same noise: it only weighs the samples, and both must be weighed alike.
  auto measured = fit_oscillations(swing.measured, swing.dt, noise, simulated->modes);
  if (!measured) return std::nullopt;
  // A short record tells a frequency and hardly a damping.
  for (int m = 0; m < static_cast<int>(start.size()); ++m)
    if (!stands_out(*simulated, m, swing, noise) || !stands_out(*measured, m, swing, noise) ||
        measured->damping_error(m) > worst_damping)
      return std::nullopt;
  return Pair{std::move(*measured), *simulated};
}

FreeSwing part(const FreeSwing& swing, Eigen::Index from, Eigen::Index samples) {
  return {swing.trial, swing.column, swing.dt, swing.measured.segment(from, samples),
          swing.simulated.segment(from, samples)};
}

Measured frequency_change(const Pair& pair) {
  const double f = pair.simulated.modes[0].frequency();
  // The error is that of the measured side alone: the simulated one has no noise.
  return {pair.measured.modes[0].frequency() / f - 1.0, pair.measured.frequency_error(0) / f};
}

Measured damping_change(const Pair& pair) {
  // A difference and no ratio, as a model may have hardly any damping.
  return {pair.measured.modes[0].damping_ratio() - pair.simulated.modes[0].damping_ratio(),
          pair.measured.damping_error(0)};
}

std::string hertz(const OscillationFit& fit) {
  return short_number(fit.modes[0].frequency()) + " Hz";
}

// The series as it was fitted, with its gaps: who doubts the numbers looks here first.
SymptomPlot swing_plot(const SymptomContext& context, const FreeSwing& swing) {
  const std::string& marker = context.experiment.markers[swing.column / 3].name;
  SymptomPlot plot{
      "Free swing of " + marker + " in " + named_trial(context.trial(swing.trial).name),
      "time since the plant is free (s)",
      std::string("position ") + "xyz"[swing.column % 3] + " (mm)",
      {{"measured", {}, {}, false}, {"simulated", {}, {}}}};
  for (Eigen::Index i = 0; i < swing.measured.size(); ++i) {
    for (SymptomSeries& series : plot.series) series.x.push_back(swing.dt * i);
    plot.series[0].y.push_back(1e3 * swing.measured[i]);
    plot.series[1].y.push_back(1e3 * swing.simulated[i]);
  }
  return plot;
}

void add_main_mode(const SymptomContext& context, const FreeSwing& swing, const Pair& pair,
                   std::vector<Symptom>& out) {
  const std::string& trial = context.trial(swing.trial).name;
  // As a share for the frequency, whose square is a stiffness, and as a difference for the damping.
  const Measured f = frequency_change(pair), z = damping_change(pair);
  Symptom frequency = make_symptom("frequency", trial, 100.0 * f.value, 100.0 * f.error);
  frequency.unit = "%";
  // In per cent. Our own error is of that size: the first frequency of a beam of 20 elements is off
  // by 0.13 %.
  frequency.least = 0.1;
  frequency.sentence = "Left alone in " + named_trial(trial) + " the plant swings at " +
                       hertz(pair.measured) + ", the model at " + hertz(pair.simulated) + " (" +
                       with_error(frequency.value, frequency.standard_error, "%") + ").";
  frequency.plot = swing_plot(context, swing);
  out.push_back(std::move(frequency));
  Symptom damping = make_symptom("damping", trial, z.value, z.error);
  damping.unit = "1";
  damping.least = 1e-3;
  damping.sentence = "In " + named_trial(trial) + " the swing dies out with a damping ratio of " +
                     short_number(pair.measured.modes[0].damping_ratio()) + ", the model's with " +
                     short_number(pair.simulated.modes[0].damping_ratio()) + " (difference " +
                     with_error(z.value, z.error, "1") + ").";
  damping.plot = swing_plot(context, swing);
  out.push_back(std::move(damping));
}

// Both sides in one plot: what the model's own nonlinearity does is no finding, and is to be seen
// beside it.
SymptomPlot amplitude_plot(const std::string& title, const std::string& label, const Pair& large,
                           const Pair& small, double (*number)(const Oscillation&)) {
  SymptomPlot plot{title,
                   "amplitude at the start of the half record (mm)",
                   label,
                   {{"measured", {}, {}, true}, {"simulated", {}, {}, true}}};
  // By amplitude from the left, as the axis runs.
  for (const Pair* pair : {&small, &large})
    for (int side = 0; side < 2; ++side) {
      const Oscillation& o = (side == 0 ? pair->measured : pair->simulated).modes[0];
      plot.series[side].x.push_back(1e3 * o.amplitude());
      plot.series[side].y.push_back(number(o));
    }
  return plot;
}

// The first half of a record swings widely, the second a little.
// Two halves of one swing, and not two trials: everything else, the grip and the load above all, is
// the same in both.
void add_by_amplitude(const SymptomContext& context, const FreeSwing& swing, const Pair& whole,
                      std::vector<Symptom>& out) {
  const Eigen::Index half = swing.measured.size() / 2;
  // A half needs periods of its own for a frequency of its own.
  const double periods = half * swing.dt * whole.simulated.modes[0].frequency();
  if (half < least_samples || periods < least_periods) return;
  const Noise& noise = context.data.position_noise();
  // Each half is compared with the model's same half: what an exponential does to a fit of a law
  // that is none is then in both.
  const auto large = fit_both(part(swing, 0, half), noise, whole.simulated.modes);
  const auto small = fit_both(part(swing, half, half), noise, whole.simulated.modes);
  // A swing that dies out within the first half leaves none to compare with.
  if (!large || !small) return;
  const std::string& trial = context.trial(swing.trial).name;
  const auto difference = [&](const std::string& name, Measured a, Measured b, double scale) {
    // The halves share no sample, so their errors are independent.
    return make_symptom(name, trial, scale * (a.value - b.value),
                        scale * std::hypot(a.error, b.error));
  };
  Symptom f = difference("frequency_by_amplitude", frequency_change(*large),
                         frequency_change(*small), 100.0);
  f.unit = "%";
  // In per cent: twice what counts for one frequency, since it is a difference of two.
  f.least = 0.2;
  f.sentence =
      "In " + named_trial(trial) + " the plant's frequency changes from wide to narrow swings by " +
      with_error(f.value, f.standard_error, "%") + " more than the model's (wide less narrow).";
  f.plot = amplitude_plot("Frequency against amplitude in " + named_trial(trial), "frequency (Hz)",
                          *large, *small, [](const Oscillation& o) { return o.frequency(); });
  out.push_back(std::move(f));
  Symptom z =
      difference("damping_by_amplitude", damping_change(*large), damping_change(*small), 1.0);
  z.unit = "1";
  // Twice that of one damping ratio, for the same reason.
  z.least = 2e-3;
  z.sentence = "In " + named_trial(trial) +
               " wide swings are damped more than narrow ones by a damping ratio " +
               with_error(z.value, z.standard_error, "1") +
               " beyond what the model does; it grows with amplitude in drag of leaves, and falls "
               "with it in friction.";
  z.plot = amplitude_plot("Damping against amplitude in " + named_trial(trial), "damping ratio (1)",
                          *large, *small, [](const Oscillation& o) { return o.damping_ratio(); });
  out.push_back(std::move(z));
}

// Damping of the second mode over that of the first, on the channel where the second one is
// strongest.
void add_second_mode(const SymptomContext& context, const FreeSwing& swing, const Pair& whole,
                     std::vector<Symptom>& out) {
  const Noise& noise = context.data.position_noise();
  // Looked for in what the first mode leaves of the simulated side, where no noise makes a peak.
  const Series left =
      swing.simulated - values_of(whole.simulated, swing.simulated.size(), swing.dt);
  const auto higher = higher_oscillation(left, swing.dt, whole.simulated.modes[0].w);
  if (!higher) return;
  // Both are fitted together from here on: the first mode alone had taken a part of the second.
  const Oscillation start[] = {whole.simulated.modes[0], *higher};
  const auto both = fit_both(swing, noise, start);
  if (!both) return;
  const auto ratio = [](const OscillationFit& fit) {
    // A ratio, because it tells laws apart whatever their size is. With mass it falls as 1 over the
    // frequency, with stiffness it rises with it.
    return fit.modes[1].damping_ratio() / fit.modes[0].damping_ratio();
  };
  // The error of a quotient, to first order. Both modes are of one fit, but their frequencies are
  // far apart, and their errors hardly correlated.
  const double z1 = both->measured.modes[0].damping_ratio();
  const double r = ratio(both->measured), model = ratio(both->simulated);
  const double error =
      std::hypot(both->measured.damping_error(1), r * both->measured.damping_error(0)) /
      std::abs(z1);
  // Turned round, so that a ratio to no damping at all ends here.
  if (!(error < 0.5 * std::max(std::abs(r), std::abs(model)))) return;
  const std::string& trial = context.trial(swing.trial).name;
  Symptom symptom = make_symptom("damping_by_mode", trial, r - model, error);
  symptom.unit = "1";
  symptom.least = 0.1;
  symptom.sentence = "In " + named_trial(trial) + " the second mode (" +
                     short_number(both->measured.modes[1].frequency()) + " Hz) is damped " +
                     with_error(r, error, "1") + " times as much as the first, in the model " +
                     short_number(model) +
                     " times; the ratio is below 1 where damping goes with "
                     "mass, 1 where it does not depend on the rate, and that of the frequencies "
                     "where it goes with stiffness.";
  out.push_back(std::move(symptom));
}

}  // namespace

void add_oscillation_symptoms(const SymptomContext& context, std::vector<Symptom>& out) {
  for (int t = 0; t < context.trials(); ++t) {
    if (!context.usable(t)) continue;
    const auto swing = free_swing(context, t);
    // A plant that is moved throughout is nowhere left to itself.
    if (!swing) continue;
    // A trial whose model does not swing has nothing to be compared.
    const auto start = main_oscillation(swing->simulated, swing->dt);
    if (!start) continue;
    const auto whole = fit_both(*swing, context.data.position_noise(), std::span(&*start, 1));
    if (!whole) continue;
    // The main mode first. What the others tell is beside it, and needs it.
    add_main_mode(context, *swing, *whole, out);
    add_by_amplitude(context, *swing, *whole, out);
    add_second_mode(context, *swing, *whole, out);
  }
}

}  // namespace pedicel::discrepancy
