#include "plugins/discrepancy/test/symptoms.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "plugins/discrepancy/test/symptom_parts.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// About a hundred symptoms are looked at in an experiment, some of them lengths of three numbers.
// At 5 deviations all together raise a false one in less than 1 % of cases.
constexpr double beyond_chance = 5.0;

// A hand or a shaker that has stopped still trembles by this share of what it did.
constexpr double at_rest = 0.01;

/// When a path moves.
/// A hand that holds still is no motion, although it has a path: what is asked is when the plant is
/// left to itself.
struct Motion {
  double from = 0.0, to = 0.0;  // s; nowhere: from = to
};

Motion motion_of(const DrivenPath& path) {
  const std::size_t n = path.time.size();
  const auto distance = [&](std::size_t i, std::size_t k) {
    return (path.position[i] - path.position[k]).norm();
  };
  // A base may be tilted in place of being moved.
  const auto angle = [&](std::size_t i, std::size_t k) {
    return path.rotation.empty() ? 0.0 : path.rotation[i].angularDistance(path.rotation[k]);
  };
  double farthest = 0.0, widest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    // The scale of the path is its own: what is still beside a push of 40 mm is a motion for one of
    // 1 mm.
    farthest = std::max(farthest, distance(i, 0));
    widest = std::max(widest, angle(i, 0));
  }
  const auto apart = [&](std::size_t i, std::size_t k) {
    return distance(i, k) > at_rest * farthest || angle(i, k) > at_rest * widest;
  };
  std::size_t first = 0, last = n;
  // From both ends inward. A path that stops in between is one motion, so that a hold there is not
  // taken for a plant that is left alone.
  while (first + 1 < n && !apart(first + 1, 0)) ++first;
  while (last > 1 && !apart(last - 2, n - 1)) --last;
  // It never moves, so it never jumps either.
  if (first + 1 >= n) return {};
  return {path.time[first], path.time[last - 1]};
}

std::vector<Motion> motions_of(const Trial& trial) {
  std::vector<Motion> motions;
  for (const Hold& hold : trial.holds) {
    motions.push_back(motion_of(hold.path));
    // After it has let go a hand may move as it likes.
    motions.back().to = std::min(motions.back().to, hold.release);
  }
  // A shaken root moves the plant as much as a hand does.
  if (trial.base) motions.push_back(motion_of(*trial.base));
  return motions;
}

// Steps of loads, releases, and where paths begin and end to move.
std::vector<double> jumps(const Trial& trial, const std::vector<Motion>& motions) {
  // The ends count as jumps, so that the spans between jumps cover the whole trial.
  std::vector<double> times{0.0, trial.duration()};
  // A load that is put on or taken off starts a swing.
  for (const TimedLoad& load : trial.loads)
    for (const double t : {load.from, load.to}) times.push_back(t);
  for (const Hold& hold : trial.holds) times.push_back(hold.release);
  for (const Motion& motion : motions)
    for (const double t : {motion.from, motion.to}) times.push_back(t);
  // Loads and holds may last beyond the record, and infinite ones never end.
  std::erase_if(times, [&](double t) { return !(t >= 0.0 && t <= trial.duration()); });
  std::ranges::sort(times);
  // A load that changes when a hand lets go is one jump.
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

bool Symptom::shows() const {
  // Significant and of a size that matters: of a long record the smallest nonsense of any model is
  // significant.
  return std::abs(value) > std::max(beyond_chance * standard_error, least);
}

double Symptom::significance() const {
  // Without noise everything that is not zero is certain.
  if (standard_error > 0.0) return std::abs(value) / standard_error;
  return value == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

Symptom make_symptom(std::string name, std::string subject, double value, double standard_error) {
  Symptom symptom;
  // From the definitions of the effects: a new effect says itself which symptoms it makes.
  symptom.speaks_for = effects::spoken_for(name);
  symptom.name = std::move(name);
  symptom.subject = std::move(subject);
  symptom.value = value;
  // The rest is for the finder, who knows the units and the words.
  symptom.standard_error = standard_error;
  return symptom;
}

std::string short_number(double value) {
  char text[32];
  // "1.23e+03" is read by nobody.
  const bool long_whole = std::abs(value) >= 999.5 && std::abs(value) < 1e6;
  std::snprintf(text, sizeof text, long_whole ? "%.0f" : "%.3g", value);
  return text;
}

// The error with one digit (two where that is a 1), the value to the same decimal.
std::string with_error(double value, double error, const std::string& unit) {
  char text[80];
  int decimals = 9;
  if (error > 0.0 && std::isfinite(error)) {
    const double power = std::floor(std::log10(error));
    // An error of 0.14 rounded to 0.1 would be off by almost a third of itself.
    decimals = static_cast<int>(error < 2.0 * std::pow(10.0, power) ? 1.0 - power : -power);
  }
  if (decimals > 5 || decimals < -3)
    std::snprintf(text, sizeof text, "%.3g \u00b1 %.2g", value, error);
  else
    std::snprintf(text, sizeof text, "%.*f \u00b1 %.*f", std::max(decimals, 0), value,
                  std::max(decimals, 0), error);
  return text + (unit == "1" ? std::string() : " " + unit);
}

bool SymptomContext::usable(int t) const {
  const Prediction& p = predictions[t];
  // Static trials have one row, and no course that could be looked at.
  return p.healthy && !trial(t).is_static && trial(t).markers.size() > 0 &&
         p.markers.rows() == trial(t).markers.value.rows() &&
         p.markers.cols() == trial(t).markers.value.cols() && p.markers.allFinite();
}

Series SymptomContext::residual(int t, int column) const {
  return trial(t).markers.value.col(column) - predictions[t].markers.col(column);
}

Eigen::MatrixXd SymptomContext::velocity(int t) const {
  const Prediction& p = predictions[t];
  // The simulator's own where there are any: between samples far apart a difference is too small by
  // far.
  if (p.marker_velocity.rows() == p.markers.rows() && p.marker_velocity.cols() == p.markers.cols())
    return p.marker_velocity;
  const std::vector<double>& time = trial(t).markers.time;
  Eigen::MatrixXd v = Eigen::MatrixXd::Zero(p.markers.rows(), p.markers.cols());
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    const Eigen::Index a = std::max<Eigen::Index>(i - 1, 0);
    const Eigen::Index b = std::min(i + 1, v.rows() - 1);
    // Central within, one-sided at the ends.
    if (b > a) v.row(i) = (p.markers.row(b) - p.markers.row(a)) / (time[b] - time[a]);
  }
  return v;
}

std::vector<Span> spans_of(const Trial& trial) {
  const std::vector<Motion> motions = motions_of(trial);
  const std::vector<double> times = jumps(trial, motions);
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    // No motion begins or ends within a span, so its middle stands for all of it.
    const double middle = 0.5 * (times[i] + times[i + 1]);
    const bool moved = std::ranges::any_of(
        motions, [&](const Motion& m) { return middle > m.from && middle < m.to; });
    spans.push_back({times[i], times[i + 1], !moved});
  }
  return spans;
}

std::vector<Symptom> symptoms(const Experiment& experiment, const DataSet& data,
                              const std::vector<Prediction>& predictions) {
  std::vector<Symptom> found;
  // A diagnosis that was stopped has no predictions, and no symptoms either.
  if (predictions.size() != experiment.trials.size()) return found;
  // Chains are made once for all finders.
  const SymptomContext context{experiment, data, predictions, chains_of(experiment)};
  // At rest first, then motion, then what is made of both: later finders read what earlier ones
  // have found.
  add_static_symptoms(context, found);
  add_motion_symptoms(context, found);
  add_oscillation_symptoms(context, found);
  add_force_symptoms(context, found);
  add_sensor_symptoms(context, found);
  add_course_symptoms(context, found);
  return found;
}

std::vector<SymptomPair> paired(const std::vector<Symptom>& before,
                                const std::vector<Symptom>& after) {
  std::vector<SymptomPair> pairs;
  for (const Symptom& symptom : before) {
    const auto same = std::ranges::find_if(
        pairs, [&](const SymptomPair& pair) { return pair.before.name == symptom.name; });
    // Of one name the clearest, since a table has one line for each.
    if (same == pairs.end())
      pairs.push_back({symptom, {}});
    else if (symptom.significance() > same->before.significance())
      same->before = symptom;
  }
  for (SymptomPair& pair : pairs)
    for (const Symptom& symptom : after) {
      if (symptom.name != pair.before.name) continue;
      // The same trial or marker if it is there, so that before and after are of one thing. Else
      // the clearest one: what was wrong may show elsewhere afterwards.
      const bool same = symptom.subject == pair.before.subject;
      const bool had = !pair.after.name.empty() && pair.after.subject == pair.before.subject;
      if (same ||
          (!had && (pair.after.name.empty() || symptom.significance() > pair.after.significance())))
        pair.after = symptom;
    }
  // What shows stands above all that does not, however significant that is: a size below `least` is
  // of no interest.
  std::ranges::stable_sort(pairs, [](const SymptomPair& a, const SymptomPair& b) {
    if (a.before.shows() != b.before.shows()) return a.before.shows();
    return a.before.significance() > b.before.significance();
  });
  return pairs;
}

}  // namespace pedicel::discrepancy
