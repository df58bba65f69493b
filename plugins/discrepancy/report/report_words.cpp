#include "plugins/discrepancy/report/report_words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/io/csv.h"
#include "plugins/discrepancy/test/symptom_parts.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

std::string unit_text(const std::string& unit) {
  return unit.empty() || unit == "1" ? "" : " " + unit;
}

std::string interval_text(const Estimate& e) {
  const bool low = std::isfinite(e.low), high = std::isfinite(e.high);
  if (low && high && e.low == e.high) return "fixed";
  if (low && high) return "95 %: " + short_number(e.low) + " to " + short_number(e.high);
  if (low) return "95 %: above " + short_number(e.low) + ", no upper end";
  if (high) return "95 %: below " + short_number(e.high) + ", no lower end";
  return "the data leave it open";
}

std::string percent(double share) {
  return short_number(100.0 * share) + " %";
}

std::string joined(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? last : ", ") + words[i];
  return text;
}

}  // namespace

std::string estimate_text(const Estimate& e) {
  return short_number(e.value) + unit_text(e.unit) + " (" + interval_text(e) + ")";
}

std::string estimate_text(const std::vector<Estimate>& estimates) {
  if (estimates.size() == 1) return estimate_text(estimates.front());
  std::string text = "[";
  for (const Estimate& e : estimates)
    text += (text.size() > 1 ? "; " : "") + short_number(e.value) + " (" + interval_text(e) + ")";
  return text + "]" + (estimates.empty() ? "" : unit_text(estimates.front().unit));
}

std::string share_text(const FitAndCheck& share) {
  std::string text = share.fit ? percent(*share.fit) : "\u2013";
  if (share.check) text += ", held out " + percent(*share.check);
  return text;
}

std::string change_text(const Change& change) {
  std::vector<std::string> parts;
  if (change.marker) parts.push_back(short_number(1e3 * *change.marker) + " mm");
  if (change.force) parts.push_back(short_number(*change.force) + " N");
  if (change.moment) parts.push_back(short_number(*change.moment) + " N m");
  if (change.pixel) parts.push_back(short_number(*change.pixel) + " px");
  return joined(parts, ", ");
}

std::string place_text(const NamedCause& cause) {
  const effects::EffectDefinition* known = effects::find_effect(cause.name);
  if (known && known->home == effects::Home::base) return "the root";
  if (const auto marker = cause.words.find("marker"); marker != cause.words.end())
    return "marker " + marker->second;
  std::string text;
  for (const char* key : {"plant", "link", "joint", "camera", "wrench"})
    if (const auto word = cause.words.find(key); word != cause.words.end())
      text += (text.empty() ? "" : ", ") + std::string(key) + " " + word->second;
  if (!text.empty()) return text;
  if (cause.where)
    text = "at " + short_number(cause.where->at) + " of the length of " + cause.where->curve;
  if (const auto trial = cause.words.find("trial"); trial != cause.words.end())
    text += (text.empty() ? "in trial " : ", in trial ") + trial->second;
  return text;
}

std::string parameters_text(const Candidate& candidate) {
  const Hypothesis& model = candidate.fit.hypothesis;
  std::string text;
  for (int p = 0; p < model.size(); ++p) {
    const FreeParameter& free = model.free[p];
    const plant::Effect& effect = model.effects[free.effect];
    if (effect.name != candidate.cause) continue;
    text += text.empty() ? "" : ", ";
    text += free.name + " " + short_number(model.value(p)) +
            (free.name == "at" ? " of " + (effect.place ? effect.place->curve : "")
                               : unit_text(free.unit));
  }
  return text;
}

std::string why_it_lost(const Candidate& candidate, const Diagnosis& d) {
  if (d.ranking.empty()) return "";
  const Candidate& best = d.ranking.front();
  if (&candidate == &best)
    return d.verdict.outcome == Outcome::unknown ? "nearest of what is known, and not enough"
                                                 : "the likeliest";
  for (std::size_t c = 1; c < d.verdict.causes.size(); ++c)
    if (d.verdict.causes[c].name == candidate.cause)
      return d.verdict.outcome == Outcome::ambiguous ? "did not lose: as likely, by these data"
                                                     : "did not lose: needed as well";
  const double behind = best.evidence - candidate.evidence;
  std::string text =
      candidate.gain < 1.0 ? "explains none of it"
      : candidate.gain < 0.1 * best.gain
          ? "explains " + percent(candidate.gain / best.gain) + " of what " + best.cause + " does"
          : short_number(behind) + " nats behind " + best.cause;
  const int extra = candidate.fit.hypothesis.size() - best.fit.hypothesis.size();
  if (extra > 0 && candidate.gain > 0.9 * best.gain)
    text += ", and needs " + std::to_string(extra) + " more parameter" + (extra > 1 ? "s" : "");
  std::set<std::string> stuck;  // but for what we allow our own mesh
  const Hypothesis& fitted = candidate.fit.hypothesis;
  for (const int p : candidate.fit.at_bound)
    if (fitted.effects[fitted.free[p].effect].name != mesh_error) stuck.insert(fitted.free[p].name);
  if (!stuck.empty())
    text +=
        "; runs to the end of its range (" + joined({stuck.begin(), stuck.end()}, " and ") + ")";
  return text;
}

std::string ratios_text(const Verdict& verdict) {
  std::string text;
  for (const auto& [name, ratio] : verdict.ratios) {
    const double within = 100.0 * (ratio.high / ratio.value - 1.0);
    text += (text.empty() ? "" : " ") + ("Of " + name) +
            " these data see only the ratio closely: " + short_number(ratio.value) +
            " times the file's, within " + short_number(within) + " %.";
  }
  return text;
}

std::string remainder_text(const Verdict& v) {
  if (v.remainder.empty()) return "";
  return (v.outcome == Outcome::unknown ? "What is known of it: " : "Still unexplained: ") +
         v.remainder + (v.remainder.ends_with('.') ? "" : ".");
}

std::string explained_text(const Verdict& v) {
  const FitAndCheck& left = v.left.share;
  const std::optional<double> share = left.check ? left.check : left.fit;
  // A number of the material alone stands in the refitted model already, and all is left.
  if (v.outcome != Outcome::named || !share || *share >= 1.0) return "";
  return "What is named explains " + share_removed(1.0 - *share) +
         " of the misfit that the refitted model leaves above the noise, on the " +
         (left.check ? "held-out" : "fitted") + " trials.";
}

std::string gain_text(const Diagnosis& d) {
  const Errors& check = d.verdict.check;
  const Errors& errors = check.refitted ? check : d.verdict.fit;
  if (!errors.refitted) return "";
  std::vector<std::string> names;
  for (const int t : check.refitted ? d.check_trials : d.fit_trials)
    names.push_back(d.admission.experiment.trials[t].name);
  // What is not a finding gains nothing: the extended model is then that of a name taken back.
  const bool taken_back = d.verdict.outcome == Outcome::unknown && d.verdict.causes.empty();
  const bool found =
      !taken_back && d.best.hypothesis.effects.size() > d.base.hypothesis.effects.size();
  std::string text = check.refitted ? "On the held-out trials (" + joined(names, " and ") + ") "
                                    : "No trial was held out; on the fitted ones ";
  text += "the residual is " + short_number(*errors.refitted) +
          " times the noise with the refitted model";
  if (found && errors.extended)
    text += ", and " + short_number(*errors.extended) + " times with the extended one";
  text +=
      " (1 is the noise floor; nominal model: " + short_number(errors.nominal.value_or(NAN)) + ").";
  if (d.verdict.gain && found)
    text += " That removes " + share_removed(*d.verdict.gain) + " of the error above the noise.";
  return text;
}

std::pair<std::vector<std::string>, std::vector<std::string>> detectable_limit_texts(
    const Verdict& verdict) {
  std::pair<std::vector<std::string>, std::vector<std::string>> lists;
  for (const DetectableLimit& limit : verdict.detectable_limits) {
    const bool seen = std::isfinite(limit.smallest) && !limit.parameter.empty();
    if (!seen) {
      lists.second.push_back(limit.name);
      continue;
    }
    // Where the plain model stands at 1 or at infinity, effects hide on that side.
    const effects::EffectParameter* size = effects::find_parameter(limit.name, limit.parameter);
    const effects::Vanishes vanishes = size ? size->vanishes : limit.vanishes;
    const bool stiff = vanishes == effects::Vanishes::at_infinity;
    const bool factor = vanishes == effects::Vanishes::at_one;
    const bool beside = vanishes == effects::Vanishes::at_nominal;
    lists.first.push_back(limit.name + ": " + limit.parameter +
                          (stiff    ? " above "
                           : factor ? " off 1 by less than "
                           : beside ? " off what the file says by less than "
                                    : " below ") +
                          short_number(factor ? std::abs(limit.smallest - 1.0) : limit.smallest) +
                          unit_text(limit.unit));
  }
  return lists;
}

std::string certainty_text(const Diagnosis& d) {
  const Verdict& v = d.verdict;
  if (v.outcome == Outcome::bad_data || v.outcome == Outcome::numerical)
    return "Nothing was concluded about the plant.";
  std::string text =
      d.before.raised
          ? "The strongest of the directed tests stands at " + short_number(d.before.statistic) +
                " (pure noise exceeds " + short_number(d.before.level) + " once in 200 times)."
          : "None of the directed tests of motion and force leaves what noise alone does "
            "(largest " +
                short_number(d.before.statistic) + ", level " + short_number(d.before.level) + ").";
  if (v.outcome == Outcome::named && !v.causes.empty()) {
    text += " The evidence for " + v.causes.front().name + " is " +
            short_number(v.causes.front().evidence) + " nats";
    if (!v.competing.empty())
      text += "; the nearest competing model, " + v.competing.front().name + ", is " +
              short_number(v.competing.front().behind) + " behind";
    text += ".";
  }
  if (v.outcome == Outcome::ambiguous)
    text +=
        " The explanations above lie within what these data can tell apart; the experiment "
        "below separates them.";
  return text;
}

std::string symptom_title(const std::string& name) {
  static const std::map<std::string, std::string> titles = {
      {"base_rotation", "turn about the root at rest"},
      {"excess_curvature", "bend at a place at rest"},
      {"junction_kink", "kink at a junction at rest"},
      {"time_shift", "delay of the markers"},
      {"out_of_plane", "motion across the plane"},
      {"frequency", "frequency of the swing"},
      {"damping", "damping of the swing"},
      {"frequency_by_amplitude", "frequency, wide less narrow swings"},
      {"damping_by_amplitude", "damping, wide less narrow swings"},
      {"damping_by_mode", "damping of mode 2 over mode 1"},
      {"loop_area", "energy that a push costs"},
      {"force_scale", "size of the force"},
      {"force_drift", "drift of a held force"},
      {"clock_trend", "stiffness by the clock"},
      {"dynamic_over_static", "stiffness, swinging over at rest"},
      {"loop_area_by_rate", "energy of pushes, by rate"},
      {"delay_by_frequency", "delay of the markers, by frequency"},
      {"force_lag", "delay of the force"},
      {"drive_history", "force by the drive's past"},
      {"bad_channel", "one deviating marker"},
      {"constant_offset", "constant offset of a marker"},
      {"length_scale", "lengths between markers"},
      {"touch_onset", "when the tool begins to touch"},
      {"touch_end", "when the tool lets go"},
      {"slip", "when the contact begins to slip"},
      {"friction_ratio", "tangential over normal force"},
      {"robot_lag", "delay of the arm's log"},
      {"image_motion", "turn of the camera's image"},
      {"wrench_at_rest", "force at rest, untouched"},
      {"moment_at_rest", "moment at rest, untouched"},
      {"plant_shift", "place of the plant at rest"}};
  const auto found = titles.find(name);
  return found == titles.end() ? name : found->second;
}

}  // namespace pedicel::discrepancy
