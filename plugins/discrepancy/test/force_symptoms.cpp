#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

// What is pushed by less does no work that could be told from noise.
constexpr double least_travel = 1.0e-3;  // m, of a held point that does work
constexpr double least_hold = 1.0;       // s, of a force whose drift is looked at

bool usable(const SymptomContext& context, int t) {
  const Trial& trial = context.trial(t);
  const Eigen::MatrixXd& force = context.predictions[t].force;
  // Where a point slides, its path is not its way.
  // One hold only is looked at, the first: a trial's force is that of one hand.
  return trial.force.size() > 0 && !trial.holds.empty() && !trial.holds.front().slides() &&
         !trial.is_static && context.usable(t) && force.rows() == trial.force.value.rows() &&
         force.cols() == 3;
}

/// The force samples of a trial while its first hold holds.
struct Push {
  int samples = 0;
  Eigen::MatrixXd path;                 // samples x 3, m, of the held point
  Eigen::MatrixXd measured, predicted;  // N
  Vec3 along = Vec3::Zero();            // main direction of travel
  double travel = 0.0;                  // m, farthest from the start
};

Push push_of(const SymptomContext& context, int t) {
  const Trial& trial = context.trial(t);
  const Hold& hold = trial.holds.front();
  Push push;
  // Up to the release: after it the force sensor reads nothing, and a loop would close over it.
  while (push.samples < trial.force.size() && trial.force.time[push.samples] < hold.release - 1e-9)
    ++push.samples;
  const Eigen::Index n = push.samples;
  push.path.resize(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    push.path.row(i) = hold.path.position_at(trial.force.time[i]).transpose();
  push.measured = trial.force.value.topRows(n);
  push.predicted = context.predictions[t].force.topRows(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 d = (push.path.row(i) - push.path.row(0)).transpose();
    if (d.norm() <= push.travel) continue;
    push.travel = d.norm();
    // The direction to the farthest place. A push need not be straight, and need not be along an
    // axis.
    push.along = d.normalized();
  }
  return push;
}

// J, the work that a force does along the path, trapezoidal: sum of weights times force.
// As weights and not as a sum: a linear function of the forces has an error that follows from their
// noise, whatever its colour.
Eigen::MatrixXd work_weights(const Eigen::MatrixXd& path) {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(path.rows(), 3);
  for (Eigen::Index i = 1; i < path.rows(); ++i) {
    const Eigen::RowVector3d step = 0.5 * (path.row(i) - path.row(i - 1));
    w.row(i) += step;
    w.row(i - 1) += step;
  }
  return w;
}

SymptomPlot loop_plot(const Push& push, const std::string& trial) {
  SymptomPlot plot{"Force against displacement in " + named_trial(trial),
                   "displacement of the held point (mm)",
                   "force along it (N)",
                   {{"measured", {}, {}}, {"simulated", {}, {}}}};
  for (Eigen::Index i = 0; i < push.samples; ++i) {
    const double d = 1e3 * (push.path.row(i) - push.path.row(0)).dot(push.along);
    for (SymptomSeries& series : plot.series) series.x.push_back(d);
    plot.series[0].y.push_back(push.measured.row(i).dot(push.along));
    plot.series[1].y.push_back(push.predicted.row(i).dot(push.along));
  }
  return plot;
}

// The area between the way out and the way back is the energy that one push costs. Only for a path
// that comes back: otherwise the elastic energy would be in it.
void add_loop(const SymptomContext& context, int t, const Push& push, std::vector<Symptom>& out) {
  const Eigen::Index n = push.samples;
  // A tenth of the way leaves a hundredth of the elastic energy in the loop.
  if ((push.path.row(n - 1) - push.path.row(0)).norm() > 0.1 * push.travel) return;
  const Eigen::MatrixXd w = work_weights(push.path);
  // Measured less simulated, since the model's own damping makes a loop as well.
  Measured difference;
  double measured = 0.0, simulated = 0.0, variance = 0.0;
  for (int c = 0; c < 3; ++c) {
    Eigen::VectorXd weight = w.col(c);
    for (Eigen::Index i = 0; i < n; ++i) {
      // A gap would be a part of the way without a force. No loop is better than one with a hole.
      if (!std::isfinite(push.measured(i, c))) return;
      measured += weight[i] * push.measured(i, c);
      simulated += weight[i] * push.predicted(i, c);
    }
    // The weights are long and smooth, so noise with a memory adds up in them far beyond its white
    // part.
    variance += std::pow(projected_std(weight, context.data.force_noise()), 2);
  }
  difference = {measured - simulated, std::sqrt(variance)};
  const Trial& trial = context.trial(t);
  // Told in the sentence, since the same loop at another rate is what friction and viscosity differ
  // in.
  const double rate = push.travel / std::max(trial.force.time[n - 1] - trial.force.time[0], 1e-9);
  Symptom symptom =
      make_symptom("loop_area", trial.name, 1e3 * difference.value, 1e3 * difference.error);
  symptom.unit = "mJ";
  symptom.sentence = "One push in " + named_trial(trial.name) + " (" +
                     short_number(1e3 * push.travel) + " mm out, " + short_number(1e3 * rate) +
                     " mm/s on average) costs " +
                     with_error(1e3 * measured, symptom.standard_error, "mJ") + ", in the model " +
                     short_number(1e3 * simulated) + " mJ.";
  // The loop itself says more than its area: friction makes corners, viscosity makes it round.
  symptom.plot = loop_plot(push, trial.name);
  out.push_back(std::move(symptom));
}

// How much larger the force is than the model's, over the whole push.
// A stiffness that is off makes all of the force so much larger. A shape that is off makes a
// constant, and does not.
void add_scale(const SymptomContext& context, int t, const Push& push, std::vector<Symptom>& out) {
  Projection projection(2);
  const Noise& noise = context.data.force_noise();
  for (int c = 0; c < 3; ++c) {
    Eigen::MatrixXd x(push.samples, 2);
    x.col(0) = push.predicted.col(c);
    // A constant along the push: the zero of a sensor must not pass for a scale. Across it there is
    // no force to be scaled.
    x.col(1).setConstant(push.along[c]);
    // Three components with one scale: a push that is not along an axis needs all of them.
    projection.add(push.measured.col(c) - push.predicted.col(c), x, noise);
  }
  Projection::Result result;
  if (!projection.solve(result)) return;
  const Measured scale = result.component(0);
  if (scale.error > 0.2) return;  // the force hardly changes
  const std::string& trial = context.trial(t).name;
  Symptom symptom = make_symptom("force_scale", trial, 100.0 * scale.value, 100.0 * scale.error);
  symptom.unit = "%";
  symptom.least = 0.2;
  symptom.sentence = "The push in " + named_trial(trial) + " needs " +
                     with_error(std::abs(symptom.value), symptom.standard_error, "%") +
                     (symptom.value < 0.0 ? " less" : " more") + " force than the model.";
  symptom.plot = loop_plot(push, trial);
  out.push_back(std::move(symptom));
}

/// Samples from <= i < to while the path stands still away from its start.
/// At the start the point may rest without a force, whose drift would be that of the sensor.
struct Rest {
  Eigen::Index from = 0, to = 0;
};

Rest longest_rest(const Push& push, const std::vector<double>& time) {
  Rest best;
  const auto length = [&](const Rest& rest) {
    return rest.to > rest.from ? time[rest.to - 1] - time[rest.from] : 0.0;
  };
  for (Eigen::Index i = 0; i < push.samples;) {
    Eigen::Index j = i + 1;
    // Against the first of the rest and not the one before: a slow creep of the path would else
    // count as standing still.
    while (j < push.samples && (push.path.row(j) - push.path.row(i)).norm() < 1e-7) ++j;
    const Rest rest{i, j};
    // What relaxes does so in proportion to the force, so only a good part of the push says
    // anything.
    const bool away = (push.path.row(i) - push.path.row(0)).norm() > 0.3 * push.travel;
    if (away && length(rest) > length(best)) best = rest;
    // Rests do not overlap, and the whole takes one pass.
    i = j;
  }
  return best;
}

void add_drift(const SymptomContext& context, int t, const Push& push, std::vector<Symptom>& out) {
  const std::vector<double>& time = context.trial(t).force.time;
  const Rest rest = longest_rest(push, time);
  const Eigen::Index n = rest.to - rest.from;
  if (n < 8) return;
  const double length = time[rest.to - 1] - time[rest.from];
  // A shorter rest is still full of the swing after the stop.
  if (length < least_hold) return;
  const Eigen::MatrixXd r = (push.measured - push.predicted).middleRows(rest.from, n);
  // By the model, as everywhere here: the measured mean has the error that is looked for.
  const Vec3 mean = push.predicted.middleRows(rest.from, n).colwise().mean().transpose();
  // Along the mean of what the model says: there the force is, and noise across it is left out.
  if (!(mean.norm() > 0.0)) return;
  // A constant beside the slope: whether the force is right at all is the question of its scale.
  Eigen::MatrixXd x(n, 2);
  SymptomPlot plot{"Force while the point is held still in " + named_trial(context.trial(t).name),
                   "time (s)",
                   "force (N)",
                   {{"measured", {}, {}, false}, {"simulated", {}, {}}}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double at = time[rest.from + i];
    x(i, 0) = 1.0;
    // Over the whole rest, so that the number is a change in newtons and not a slope.
    x(i, 1) = (at - time[rest.from]) / length;
    for (SymptomSeries& series : plot.series) series.x.push_back(at);
    plot.series[0].y.push_back(push.measured.row(rest.from + i).dot(mean.normalized()));
    plot.series[1].y.push_back(push.predicted.row(rest.from + i).dot(mean.normalized()));
  }
  Projection projection(2);
  // The noise of a projection on a unit vector is that of one component.
  projection.add(r * mean.normalized(), x, context.data.force_noise());
  Projection::Result result;
  if (!projection.solve(result)) return;
  const Measured drift = result.component(1);
  const std::string& trial = context.trial(t).name;
  Symptom symptom = make_symptom("force_drift", trial, drift.value, drift.error);
  symptom.unit = "N";
  symptom.sentence = "While the point is held still in " + named_trial(trial) + " (" +
                     short_number(length) + " s) the force changes by " +
                     with_error(drift.value, drift.error, "N") + " more than in the model, of " +
                     short_number(mean.norm()) + " N.";
  symptom.plot = std::move(plot);
  out.push_back(std::move(symptom));
}

/// A stiffness relative to the model's, by the clock.
struct Reading {
  double clock, value, error;
};

// The slope of a straight line through readings; its error widened where they scatter more.
// Least squares with weights, about the weighted centre. Scatter beyond the errors is what other
// faults of the model put into single trials.
bool slope_of(const std::vector<Reading>& readings, Measured& slope) {
  double w = 0.0, wx = 0.0, wy = 0.0;
  for (const Reading& r : readings) {
    // By the inverse variance: one precise trial is worth many poor ones.
    const double weight = 1.0 / (r.error * r.error);
    w += weight, wx += weight * r.clock, wy += weight * r.value;
  }
  double xx = 0.0, xy = 0.0;
  for (const Reading& r : readings) {
    const double weight = 1.0 / (r.error * r.error);
    xx += weight * std::pow(r.clock - wx / w, 2);
    xy += weight * (r.clock - wx / w) * (r.value - wy / w);
  }
  // Two readings always lie on a line, and nothing tells how well.
  if (readings.size() < 3 || !(xx > 0.0)) return false;
  slope = {xy / xx, 1.0 / std::sqrt(xx)};
  double chi = 0.0;
  for (const Reading& r : readings)
    chi += std::pow((r.value - wy / w - slope.value * (r.clock - wx / w)) / r.error, 2);
  // Never narrower than noise makes it: few readings may lie on a line by chance.
  slope.error *= std::sqrt(std::max(1.0, chi / static_cast<double>(readings.size() - 2)));
  return true;
}

// Stiffness goes with the square of a frequency and with the force of a push. Each kind for
// itself, because a wrong model offsets them differently.
// The clock runs through the whole experiment and not from each trial's start: it is what dries,
// warms or grows that shows here.
void add_clock_trend(const SymptomContext& context, std::vector<Symptom>& out) {
  std::map<std::string, std::vector<Reading>> kinds;
  for (const Symptom& symptom : out)
    for (int t = 0; t < context.trials(); ++t) {
      if (symptom.subject != context.trial(t).name || !(symptom.standard_error > 0.0)) continue;
      // Both as a share of the stiffness: twice that of a frequency, and once that of a force.
      const double scale = symptom.name == "frequency"     ? 2.0
                           : symptom.name == "force_scale" ? 1.0
                                                           : 0.0;
      // An ordered map: which kind is told first must not depend on addresses.
      if (scale > 0.0)
        kinds[symptom.name].push_back(
            {context.trial(t).clock, scale * symptom.value, scale * symptom.standard_error});
    }
  // Few readings of each, and one line through them. The plot has the readings, which say more than
  // the line.
  for (const auto& [kind, readings] : kinds) {
    Measured slope;
    if (!slope_of(readings, slope)) continue;
    double first = readings[0].clock, last = first;
    SymptomPlot plot{"Stiffness by the clock, from " +
                         std::string(kind == "frequency" ? "free swings" : "pushes"),
                     "clock (s)",
                     "stiffness against the model (%)",
                     {{"trials", {}, {}, false}}};
    for (const Reading& r : readings) {
      first = std::min(first, r.clock), last = std::max(last, r.clock);
      plot.series[0].x.push_back(r.clock);
      plot.series[0].y.push_back(r.value);
    }
    // Told as the change from first to last: a slope per second means nothing to a reader.
    const double span = last - first;
    Symptom symptom = make_symptom("clock_trend", kind == "frequency" ? "free swings" : "pushes",
                                   span * slope.value, span * slope.error);
    symptom.unit = "%";
    symptom.least = 0.3;
    symptom.sentence = "From the first trial to the last (" + short_number(span) +
                       " s) the stiffness seen in " + symptom.subject + " changes by " +
                       with_error(symptom.value, symptom.standard_error, "%") +
                       " against the model's.";
    symptom.plot = std::move(plot);
    out.push_back(std::move(symptom));
  }
}

}  // namespace

void add_force_symptoms(const SymptomContext& context, std::vector<Symptom>& out) {
  for (int t = 0; t < context.trials(); ++t) {
    if (!usable(context, t)) continue;
    const Push push = push_of(context, t);
    // Fewer samples than that make no loop and no line.
    if (push.samples < 8) continue;
    // What hardly moves has neither a loop nor a scale, and its drift is the sensor's.
    if (push.travel > least_travel) {
      add_loop(context, t, push, out);
      add_scale(context, t, push, out);
      add_drift(context, t, push, out);
    }
  }
  // After all trials, since it reads what they have put into the list.
  add_clock_trend(context, out);
}

}  // namespace pedicel::discrepancy
