#include "plugins/discrepancy/test/foretold.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "plugins/discrepancy/data/places.h"
#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/test/symptom_parts.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// A way of less than this many noise units says nothing of a share of it.
constexpr double least_way = 10.0;

// No hand holds it: where one does, the plant rests where it is led.
bool is_left(const SymptomContext& context, const StaticStretch& stretch) {
  const Trial& trial = context.trial(stretch.trial);
  const double from = trial.markers.time[stretch.from];
  return std::ranges::all_of(trial.holds,
                             [&](const Hold& hold) { return hold.release <= from + 1e-9; });
}

constexpr double last_part = 0.2;      // of a record
constexpr double hardly_moves = 0.05;  // of the way, RMS

// The end of a trial whose swing has nearly died out: precise data ask a resting plant for more
// stillness than it has.
std::optional<StaticStretch> last_swings(const SymptomContext& context, int t) {
  if (!context.usable(t)) return {};
  const std::vector<double>& time = context.trial(t).markers.time;
  const double begins = time.back() - last_part * (time.back() - time.front());
  const auto from = static_cast<int>(std::ranges::lower_bound(time, begins) - time.begin());
  const auto to = static_cast<int>(time.size());
  if (to - from < 16) return {};
  const Eigen::MatrixXd end = context.predictions[t].markers.middleRows(from, to - from);
  const Eigen::RowVectorXd mean = end.colwise().mean();
  double way = 0.0;
  for (int m = 0; m < context.markers(); ++m) {
    const plant::CurvePlace& place = context.experiment.markers[m].place;
    for (const plant::PlantCurve& curve : context.experiment.plant().curves)
      if (curve.name == place.curve)
        way += (mean.segment<3>(3 * m).transpose() - drawn_point(curve, place.at)).squaredNorm();
  }
  const double motion = (end.rowwise() - mean).squaredNorm() / (to - from);
  if (std::sqrt(motion) > hardly_moves * std::sqrt(way)) return {};
  return stretch_of(context, t, from, to);
}

// The residual at rest along the way from the drawn shape to where the model rests, over that way:
// a plant that is softer throughout goes as much farther at all its markers.
std::optional<Foretold> at_rest(const SymptomContext& context, const StaticStretch& stretch) {
  double xx = 0.0, xy = 0.0, yy = 0.0, way = 0.0, count = 0.0;
  for (int m = 0; m < context.markers(); ++m) {
    const plant::CurvePlace& place = context.experiment.markers[m].place;
    const auto curve =
        std::ranges::find(context.experiment.plant().curves, place.curve, &plant::PlantCurve::name);
    if (curve == context.experiment.plant().curves.end()) continue;
    const Vec3 drawn = drawn_point(*curve, place.at);
    for (int axis = 0; axis < 3; ++axis) {
      const int c = 3 * m + axis;
      if (!std::isfinite(stretch.mean[c]) || !(stretch.error[c] > 0.0)) continue;
      const double weight = std::pow(stretch.error[c], -2);
      const double x = stretch.position[c] - drawn[axis];
      xx += weight * x * x;
      xy += weight * x * stretch.mean[c];
      yy += weight * stretch.mean[c] * stretch.mean[c];
      way += x * x;
      count += 1.0;
    }
  }
  if (!(std::sqrt(way) > least_way * context.data.position_noise().std) || !(xx > 0.0)) return {};
  Foretold found;
  found.trial = stretch.trial;
  found.off = xy / xx;
  // What does not go along that way widens the error: then it is no matter of a share.
  const double scatter = count > 1.0 ? (yy - found.off * xy) / (count - 1.0) : 1.0;
  found.error = std::sqrt(std::max(1.0, scatter) / xx);
  return found;
}

std::string listed(std::vector<std::string> names) {
  // A cause may speak in two ways, and is told once.
  std::vector<std::string> once;
  for (std::string& name : names)
    if (std::ranges::find(once, name) == once.end()) once.push_back(std::move(name));
  std::string text;
  for (const std::string& name : once) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// The largest of one kind over some trials; null where there is none.
template <class Wanted>
const Foretold* worst(const std::vector<Foretold>& all, const Wanted& wanted) {
  const Foretold* found = nullptr;
  for (const Foretold& one : all)
    if (wanted(one) && (!found || std::abs(one.off) > std::abs(found->off))) found = &one;
  return found;
}

bool misses(const Foretold* one) {
  return one && std::abs(one->off) > well_foretold;
}

std::string said(const Experiment& experiment, const Foretold& one) {
  const double percent = 100.0 * std::abs(one.off);
  const std::string trial = named_trial(experiment.trials[one.trial].name);
  const bool more = one.off > 0.0;
  return one.what == Foretold::What::rest
             ? "in " + trial + " the plant rests " + short_number(percent) + " % " +
                   (more ? "farther from" : "nearer to") + " its drawn shape"
             : "in " + trial + " it swings " + short_number(percent) + " % " +
                   (more ? "faster" : "more slowly");
}

}  // namespace

std::vector<Foretold> foretold(const Experiment& experiment, const DataSet& data,
                               const std::vector<Prediction>& predictions) {
  std::vector<Foretold> found;
  if (predictions.size() != experiment.trials.size()) return found;
  const SymptomContext context{experiment, data, predictions, chains_of(experiment)};
  const std::vector<StaticStretch> stretches = static_stretches(context);
  std::vector<Symptom> swings;
  add_oscillation_symptoms(context, swings);
  for (int t = 0; t < context.trials(); ++t) {
    // The last one: what came before may have been held.
    const auto last = std::ranges::find_if(
        stretches.rbegin(), stretches.rend(),
        [&](const StaticStretch& s) { return s.trial == t && is_left(context, s); });
    std::optional<StaticStretch> stretch;
    if (last != stretches.rend()) stretch = *last;
    if (!stretch) stretch = last_swings(context, t);
    if (stretch && is_left(context, *stretch))
      if (const auto rest = at_rest(context, *stretch)) found.push_back(*rest);
    for (const Symptom& symptom : swings)
      if (symptom.name == "frequency" && symptom.subject == experiment.trials[t].name)
        found.push_back(
            {t, Foretold::What::frequency, 0.01 * symptom.value, 0.01 * symptom.standard_error});
  }
  return found;
}

std::string foretold_text(const Experiment& experiment, const std::vector<Foretold>& all,
                          const std::vector<int>& held_out) {
  const auto is_held_out = [&](const Foretold& one) {
    return std::ranges::find(held_out, one.trial) != held_out.end();
  };
  const auto of = [&](Foretold::What what, bool held) {
    return worst(all, [&, what, held](const Foretold& one) {
      return one.what == what && is_held_out(one) == held;
    });
  };
  const Foretold *rest = of(Foretold::What::rest, true),
                 *swing = of(Foretold::What::frequency, true);
  if (!rest && !swing) return "";
  const std::string percent = short_number(100.0 * well_foretold) + " %";
  if (!misses(rest) && !misses(swing))
    return std::string(!rest    ? "Frequencies"
                       : !swing ? "Places at rest"
                                : "Places at rest and frequencies") +
           " of the trials held out are predicted within " + percent + ".";
  std::string text = "Not predicted within " + percent + ": ";
  if (misses(rest)) text += said(experiment, *rest);
  if (misses(swing)) text += (misses(rest) ? ", " : "") + said(experiment, *swing);
  text += " than the model. ";
  if (misses(rest) != misses(swing) && rest && swing)
    text += misses(rest) ? "Its swings are predicted. " : "Its places at rest are predicted. ";
  // What depends on the load is not seen in trials with another one.
  const Foretold *fitted_rest = of(Foretold::What::rest, false),
                 *fitted_swing = of(Foretold::What::frequency, false);
  const bool by_load = (misses(rest) && fitted_rest && !misses(fitted_rest)) ||
                       (misses(swing) && fitted_swing && !misses(fitted_swing));
  std::vector<std::string> causes;
  const auto add = [&](const char* symptom) {
    std::ranges::move(effects::spoken_for(symptom), std::back_inserter(causes));
  };
  std::string missing = "a stiffness that is another one";
  if (misses(rest) != misses(swing) && rest && swing) {
    missing += " at rest than in swings";
    add("dynamic_over_static");
  }
  if (by_load) {
    missing += std::string(causes.empty() ? "" : ", and") + " under another load than in the " +
               "fitted trials";
    add("frequency_by_amplitude");
  }
  if (causes.empty()) {
    missing = "what both the fitted trials and these ask for";
    add("frequency");
  }
  return text + "Missing is " + missing + "; that would make " + listed(causes) +
         ". Fit one of these trials, too.";
}

}  // namespace pedicel::discrepancy
