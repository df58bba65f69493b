#include "pedicel/discrepancy/test/symptoms.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "pedicel/discrepancy/test/symptom_parts.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

constexpr double beyond_chance = 5.0;

// A hand or a shaker that has stopped still trembles by this share of what it did.
constexpr double at_rest = 0.01;

/// When a path moves.
struct Motion {
  double from = 0.0, to = 0.0;  // s; nowhere: from = to
};

Motion motion_of(const DrivenPath& path) {
  const std::size_t n = path.time.size();
  const auto distance = [&](std::size_t i, std::size_t k) {
    return (path.position[i] - path.position[k]).norm();
  };
  const auto angle = [&](std::size_t i, std::size_t k) {
    return path.rotation.empty() ? 0.0 : path.rotation[i].angularDistance(path.rotation[k]);
  };
  double farthest = 0.0, widest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    farthest = std::max(farthest, distance(i, 0));
    widest = std::max(widest, angle(i, 0));
  }
  const auto apart = [&](std::size_t i, std::size_t k) {
    return distance(i, k) > at_rest * farthest || angle(i, k) > at_rest * widest;
  };
  std::size_t first = 0, last = n;
  while (first + 1 < n && !apart(first + 1, 0)) ++first;
  while (last > 1 && !apart(last - 2, n - 1)) --last;
  if (first + 1 >= n) return {};
  return {path.time[first], path.time[last - 1]};
}

std::vector<Motion> motions_of(const Trial& trial) {
  std::vector<Motion> motions;
  for (const Hold& hold : trial.holds) {
    motions.push_back(motion_of(hold.path));
    motions.back().to = std::min(motions.back().to, hold.release);
  }
  if (trial.base) motions.push_back(motion_of(*trial.base));
  return motions;
}

// Steps of loads, releases, and where paths begin and end to move.
std::vector<double> jumps(const Trial& trial, const std::vector<Motion>& motions) {
  std::vector<double> times{0.0, trial.duration()};
  for (const TimedLoad& load : trial.loads)
    for (const double t : {load.from, load.to}) times.push_back(t);
  for (const Hold& hold : trial.holds) times.push_back(hold.release);
  for (const Motion& motion : motions)
    for (const double t : {motion.from, motion.to}) times.push_back(t);
  std::erase_if(times, [&](double t) { return !(t >= 0.0 && t <= trial.duration()); });
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

bool Symptom::shows() const {
  return std::abs(value) > std::max(beyond_chance * standard_error, least);
}

double Symptom::significance() const {
  if (standard_error > 0.0) return std::abs(value) / standard_error;
  return value == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

Symptom make_symptom(std::string name, std::string subject, double value, double standard_error) {
  Symptom symptom;
  symptom.speaks_for = effects::spoken_for(name);
  symptom.name = std::move(name);
  symptom.subject = std::move(subject);
  symptom.value = value;
  symptom.standard_error = standard_error;
  return symptom;
}

std::string short_number(double value) {
  char text[32];
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
  return p.healthy && !trial(t).is_static && trial(t).markers.size() > 0 &&
         p.markers.rows() == trial(t).markers.value.rows() &&
         p.markers.cols() == trial(t).markers.value.cols() && p.markers.allFinite();
}

Series SymptomContext::residual(int t, int column) const {
  return trial(t).markers.value.col(column) - predictions[t].markers.col(column);
}

Eigen::MatrixXd SymptomContext::velocity(int t) const {
  const Prediction& p = predictions[t];
  if (p.marker_velocity.rows() == p.markers.rows() && p.marker_velocity.cols() == p.markers.cols())
    return p.marker_velocity;
  const std::vector<double>& time = trial(t).markers.time;
  Eigen::MatrixXd v = Eigen::MatrixXd::Zero(p.markers.rows(), p.markers.cols());
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    const Eigen::Index a = std::max<Eigen::Index>(i - 1, 0);
    const Eigen::Index b = std::min(i + 1, v.rows() - 1);
    if (b > a) v.row(i) = (p.markers.row(b) - p.markers.row(a)) / (time[b] - time[a]);
  }
  return v;
}

std::vector<Span> spans_of(const Trial& trial) {
  const std::vector<Motion> motions = motions_of(trial);
  const std::vector<double> times = jumps(trial, motions);
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
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
  if (predictions.size() != experiment.trials.size()) return found;
  const SymptomContext context{experiment, data, predictions, chains_of(experiment)};
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
    if (same == pairs.end())
      pairs.push_back({symptom, {}});
    else if (symptom.significance() > same->before.significance())
      same->before = symptom;
  }
  for (SymptomPair& pair : pairs)
    for (const Symptom& symptom : after) {
      if (symptom.name != pair.before.name) continue;
      const bool same = symptom.subject == pair.before.subject;
      const bool had = !pair.after.name.empty() && pair.after.subject == pair.before.subject;
      if (same ||
          (!had && (pair.after.name.empty() || symptom.significance() > pair.after.significance())))
        pair.after = symptom;
    }
  std::ranges::stable_sort(pairs, [](const SymptomPair& a, const SymptomPair& b) {
    if (a.before.shows() != b.before.shows()) return a.before.shows();
    return a.before.significance() > b.before.significance();
  });
  return pairs;
}

}  // namespace pedicel::discrepancy
