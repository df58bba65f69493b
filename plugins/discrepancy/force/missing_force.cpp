#include "plugins/discrepancy/force/missing_force.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "plugins/discrepancy/data/places.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/force/force_course.h"
#include "plugins/discrepancy/force/force_refits.h"
#include "plugins/discrepancy/select/continuation.h"
#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/simulate/force_term.h"

namespace pedicel::discrepancy {

namespace {

// Of laws in the library. Each place is tried with all of them, and a choice among so many is paid
// for.
constexpr std::size_t kinds = 11;

class Inference {
 public:
  Inference(Evaluator& evaluator, const FitSummary& model, const MissingForceOptions& options)
      : evaluator_(evaluator),
        model_(model),
        options_(options),
        levels_(options.fit.settings->levels),
        experiment_(evaluator.data().experiment()) {
    // Of the fitted trials: these judge laws, while trials held out have a word of their own at the
    // end.
    scales_.samples = evaluator.data().samples(options.fit.trials);
    for (const plant::PlantCurve& curve : experiment_.plant().curves)
      scales_.length = std::max(scales_.length, drawn_length(curve));
    for (const Trial& trial : experiment_.trials) {
      scales_.duration = std::max(scales_.duration, trial.duration());
      scales_.trials.push_back(trial.name);
    }
  }

  MissingForce run() {
    choose_centre();
    look_at_places();
    // Before any law: a camera that moves looks like a force everywhere, and laws would be fitted
    // to it.
    const bool of_sensor = look_at_sensor();
    // Half of a search names the place that happened to come first.
    if (stopped()) {
      places_.clear();
    } else if (of_sensor) {
      conclude_sensor();
      // A free force contains every law. Where even it explains too little, none of them can do
      // better.
    } else if (!places_.empty() && places_.front().free.evidence > options_.least_evidence) {
      try_laws();
      ForceRefits refits(evaluator_, model_, centre_, places_, scales_, options_);
      // Gains are counted from the model and forces act on the centre: what a force only makes up
      // for is then no gain.
      refits.run(std::move(terms_));
      result_.terms = refits.laws();
      result_.fit = refits.best();
      // By the refits, since the linear response flatters large forces.
      if (!result_.terms.empty()) result_.evidence = result_.terms.front().evidence;
      if (!stopped()) conclude();
    }
    // Those of refits are counted by the evaluator's own simulator.
    result_.simulations = responses_->simulations();
    return std::move(result_);
  }

 private:
  // What is found then is not used.
  bool stopped() const {
    const std::atomic<bool>* stop = evaluator_.simulator().stop();
    return stop && *stop;
  }

  void note(const std::string& sentence) const {
    if (options_.note) options_.note(sentence);
  }

  // Markers spread over the plant.
  std::vector<int> markers() const {
    std::vector<int> all;
    // Curve by curve from the foot on, so that the few that are chosen lie on all of them.
    for (const MarkerChain& chain : chains_of(experiment_))
      for (std::size_t m = 0; m < chain.markers.size(); ++m)
        // At the foot a force moves nothing, and any size of it would do.
        if (chain.arc[m] > 0.02 * chain.length) all.push_back(chain.markers[m]);
    const auto most_places = static_cast<std::size_t>(options_.fit.settings->budget.force_places);
    // Each place takes some hundred simulations a trial.
    if (all.size() <= most_places) return all;
    std::vector<int> chosen;
    for (std::size_t i = 0; i < most_places; ++i)
      // With both ends: a tip is where things touch.
      chosen.push_back(all[i * (all.size() - 1) / (most_places - 1)]);
    return chosen;
  }

  // Half of a chi-square with a degree of freedom a sample: what perfect models cost, too.
  double noise_cost() const { return 0.5 * scales_.samples; }

  // Where no number of the plant can stand for a force, it pulls them far away all the same: the
  // plant as it was believed to be answers more like the real one then.
  void choose_centre() {
    // Mostly the model itself is where forces act.
    centre_ = model_;
    if (conflicts_with_prior(model_, *options_.fit.settings)) {
      note("The refitted plant contradicts what is known of it: forces act on the nominal one.");
      FitOptions none = options_.fit;
      // Looked at and not fitted: fitted, it would be pulled away again.
      none.iterations = 0;
      centre_ = fit(evaluator_, at_prior(model_.hypothesis), none);
      // Corrections of mesh and step hold near the model at which they were taken.
      if (options_.correct_at) options_.correct_at(centre_);
    }
    const Simulator& simulator = evaluator_.simulator();
    // Responses are differences, in which errors of a coarse mesh cancel.
    const double distance = options_.response_distance > 0.0 ? options_.response_distance
                                                             : simulator.numerics().distance;
    responses_ =
        std::make_unique<ForceResponses>(experiment_, evaluator_.data(), centre_, options_.fit,
                                         distance, options_.threads, simulator.stop());
  }

  void look_at_places() {
    double most = 0.0;
    // At markers, because there the motion is known that laws go by. A refit moves the place
    // between them.
    for (const int marker : markers()) {
      // Places that were looked at by then are dropped by the caller.
      if (stopped()) return;
      ForcePlace place;
      place.space = responses_->force_at(marker);
      place.free = free_history(place.space);
      // Laws need to know where the place was, and it went there with the force.
      place.path = responses_->path(place.space, place.free.value);
      most = std::max(most, place.free.gain);
      places_.push_back(std::move(place));
    }
    // By evidence and not by gain: a place that moves much explains noise, too.
    std::ranges::stable_sort(places_, [](const ForcePlace& a, const ForcePlace& b) {
      return a.free.evidence > b.free.evidence;
    });
    for (const ForcePlace& place : places_)
      note("A free force at " + place_text(place.space.place) +
           text(": evidence %.4g", place.free.evidence));
    // What the best free force leaves is the model's own error. Laws are judged in units of it.
    scales_.dispersion = std::max(1.0, (centre_.cost - most) / noise_cost());
    scales_.choices = kinds * std::max<std::size_t>(1, places_.size());
  }

  // Whether markers that move by themselves explain the data better than any force does. One alone
  // could always have moved so.
  bool look_at_sensor() {
    // Nothing would say otherwise: the plant may have stood still.
    if (experiment_.markers.size() < 2) return false;
    std::vector<std::vector<int>> groups{{}};
    for (int m = 0; m < static_cast<int>(experiment_.markers.size()); ++m) {
      // All alike is the frame of the camera, one alone is a marker that came loose. Other groups
      // have no such meaning.
      groups.front().push_back(m);
      groups.push_back({m});
    }
    for (const std::vector<int>& group : groups) {
      if (stopped()) return false;
      const double evidence = free_history(responses_->displacement_of(group)).evidence;
      if (evidence <= sensor_evidence_) continue;
      sensor_evidence_ = evidence;
      sensor_ = group;
    }
    // Against the best place of a force, and at least what is told of anything from outside.
    const double force = places_.empty() ? 0.0 : places_.front().free.evidence;
    note(text("A free displacement of markers: evidence %.4g", sensor_evidence_));
    // By a clear margin: displacements are freer than forces, which have to bend the plant.
    return sensor_evidence_ > std::max(force, levels_.outside_evidence) + levels_.clear_margin;
  }

  void conclude_sensor() {
    result_.found = true;
    result_.kind = "sensor";
    result_.evidence = sensor_evidence_;
    // No place on the plant is told: there is nothing to look for there.
    result_.where = sensor_.size() > 1 ? "All markers move alike: the camera's frame or the base"
                                       : "Marker \"" + experiment_.markers[sensor_.front()].name +
                                             "\" moves on its own: the marker, not the plant";
    // Once more, since histories of all groups were not kept, and nothing is simulated for it.
    const FreeForce free = free_history(responses_->displacement_of(sensor_));
    result_.share = share_of(free.gain);
  }

  double share_of(double gain) const {
    // Of what the refitted model leaves above the noise: noise can be explained by nothing.
    return std::clamp(gain / std::max(1.0, model_.cost - noise_cost()), 0.0, 1.0);
  }

  void try_laws() {
    std::map<std::string, std::size_t> tried;  // places of each curve
    for (const ForcePlace& place : places_) {
      if (stopped()) return;
      // Places along one curve answer much alike, so two of each are enough. Those with the most
      // evidence are tried in any case.
      const bool strong = &place - places_.data() < options_.fit.settings->budget.strong_places;
      if (++tried[place.space.place.curve] > 2 && !strong) continue;
      // Without any simulation: thousands of laws are tried in each place.
      const std::vector<ForceTerm> terms = regress_force(place.space, place.path, scales_);
      for (const ForceTerm& term : terms)
        note("  " + kind_of(term.force) + " at " + place_text(*term.force.place) +
             text(": evidence %.4g with %g numbers", term.evidence, term.parameters));
      terms_.insert(terms_.end(), terms.begin(), terms.end());
    }
    std::ranges::stable_sort(
        terms_, [](const ForceTerm& a, const ForceTerm& b) { return a.evidence > b.evidence; });
  }

  void conclude() {
    const ForcePlace& strongest = places_.front();
    if (result_.evidence >= levels_.outside_evidence) {
      const plant::Effect& force = result_.terms.front().force;
      result_.found = true;
      result_.kind = plain_kind(force);
      result_.place = force.place;
      // From the refitted model and not from the centre: what numbers of the plant explain is not
      // the force's.
      result_.share = share_of(model_.cost - result_.fit.cost);
      result_.what = "It fits best as this: " + describe(force);
      describe_course(
          course_of_law(evaluator_.simulator(), result_.fit.hypothesis, options_.fit.trials),
          kind_of(force));
      // Sentences first say what it is, and then how well that is known.
      find_elsewhere();
      find_other_kinds();
      check();
      // A free force acts on the centre, which is worse than the model: what it makes up for first
      // is not its own.
    } else if (strongest.free.evidence - (centre_.cost - model_.cost) >= levels_.outside_evidence) {
      result_.found = true;
      result_.kind = "force of no known law";
      // A marker: without a law nothing moves the place along its curve.
      result_.place = strongest.space.place;
      result_.evidence = strongest.free.evidence - (centre_.cost - model_.cost);
      result_.share = share_of(strongest.free.gain - (centre_.cost - model_.cost));
      // A person may see what the library does not have: place and course are told all the same.
      result_.what = "No law of the library follows it";
      describe_course(course_of_history(strongest.space, strongest.path, strongest.free.value), "");
    }
    // Last, as check() may have taken it back.
    if (result_.found) result_.where = where_text();
  }

  // How well the place is known: along its curve, and on which one.
  void find_elsewhere() {
    const Hypothesis& model = result_.fit.hypothesis;
    // The place is one of the fitted numbers, so its deviation has in it what the law's other
    // numbers trade with it.
    for (int p = 0; p < model.size(); ++p)
      if (model.free[p].name == "at" && model.effects[model.free[p].effect].name == missing_force &&
          // At the end of a curve the place is at its bound, and no deviation is known.
          std::isfinite(result_.fit.standard_error[p]))
        result_.place_error =
            std::hypot(model.free[p].scale * result_.fit.standard_error[p], node_share());
    // One place of each other curve: along a curve the deviation says it.
    std::set<std::string> known{result_.place->curve};
    for (const ForceTerm& term : result_.terms)
      // Odds of 20 to 1 in favour of the best leave the others alive, and a person may see at once
      // which place it is.
      if (term.evidence > result_.evidence - levels_.clear_odds &&
          known.insert(term.force.place->curve).second)
        result_.elsewhere.push_back(*term.force.place);
  }

  // The deviation of a place that is only known to a node, of its curve's length: precise data
  // would know it better, were the law and the mesh exact.
  double node_share() const {
    for (const plant::PlantCurve& curve : experiment_.plant().curves)
      if (curve.name == result_.place->curve)
        return evaluator_.simulator().numerics().distance / std::sqrt(12.0) / drawn_length(curve);
    return 0.0;
  }

  void find_other_kinds() {
    const ForceTerm& best = result_.terms.front();
    // Each kind once, whatever its places.
    std::set<std::string> known{result_.kind};
    for (const ForceTerm& term : result_.terms) {
      // The kind with a near end has one number more, and contains the other. It does as well where
      // the gains are equal: its price would always refuse it.
      const bool near_end = kind_of(term.force) == kind_with_near_end(kind_of(best.force));
      const bool as_well = near_end ? term.gain > best.gain - levels_.clear_odds
                                    : term.evidence > best.evidence - levels_.clear_odds;
      if (as_well && known.insert(plain_kind(term.force)).second)
        result_.other_kinds.push_back(plain_kind(term.force));
    }
  }

  std::string where_text() const {
    std::string where =
        "A force acts on " + result_.place->curve + text(" at %.2g", result_.place->at) +
        (result_.place_error > 0.0 ? text(" ± %.1g", result_.place_error) : "") + " of its length";
    for (const plant::CurvePlace& other : result_.elsewhere)
      where += (&other == result_.elsewhere.data() ? "; one on " : " or on ") + place_text(other);
    return where + (result_.elsewhere.empty() ? "" : " would explain the data as well");
  }

  void describe_course(const ForceCourse& course, const std::string& kind) {
    result_.when = when_it_acts(course, kind);
    result_.how = what_it_does(course);
  }

  // RMS error in noise units over the held-out trials, without and with the force.
  void check() {
    // Without any the force stands by the fitted trials alone.
    if (options_.check.empty()) return;
    // Nothing is fitted there: a force that is really outside does the same in trials it was not
    // fitted to.
    FitOptions kept = options_.fit;
    kept.trials = options_.check;
    const std::vector<Hypothesis> models{model_.hypothesis, result_.fit.hypothesis};
    const auto predicted = evaluator_.predictions(models, kept);
    // By the noise of a sample and not whitened: this number is told to people beside others of its
    // kind.
    double error[2];
    for (int m = 0; m < 2; ++m) {
      double sum = 0.0, count = 0.0;
      for (std::size_t t = 0; t < kept.trials.size(); ++t) {
        const Eigen::MatrixXd r =
            evaluator_.data().scaled_residual(kept.trials[t], predicted[m][t]);
        for (const double x : r.reshaped())
          if (std::isfinite(x)) sum += x * x, count += 1.0;
      }
      error[m] = std::sqrt(sum / std::max(count, 1.0));
    }
    note(text("Held-out trials: %.4g of the noise without it, %.4g with it", error[0], error[1]));
    // Within the noise there is nothing to gain.
    if (error[0] > 1.0) result_.gain = (error[0] - error[1]) / (error[0] - 1.0);
    // A little worse is chance, and trials in which the force hardly acts show nothing of it.
    if (error[1] <= levels_.held_out_worse * error[0]) return;
    // A wrong force is worse than none: people would act on it.
    result_.found = false;
    result_.refused =
        text(
            "A force would explain %.0f %% of what the refitted model leaves of the "
            "fitted trials, but with it the held-out ones are worse",
            100.0 * result_.share) +
        text(" (%.3g times the noise in place of %.3g). Do not extrapolate.", error[1], error[0]);
  }

  Evaluator& evaluator_;
  const FitSummary& model_;
  const MissingForceOptions& options_;
  const Levels& levels_;
  const Experiment& experiment_;
  FitSummary centre_;  ///< the model about which forces act: `model_`, or what it was pulled from
  std::unique_ptr<ForceResponses> responses_;
  LibraryScales scales_;
  std::vector<ForcePlace> places_;
  std::vector<int> sensor_;
  double sensor_evidence_ = 0.0;
  std::vector<ForceTerm> terms_;
  MissingForce result_;
};

}  // namespace

std::string MissingForce::sentence() const {
  if (!found) return refused;
  std::string all =
      where + ". " +
      text("It explains %.0f %% of what the refitted model leaves above the noise.", 100.0 * share);
  if (!kind.empty()) all += " Kind: " + kind;
  for (const std::string& other : other_kinds) all += " or " + other;
  if (!other_kinds.empty()) all += ", which these data cannot tell apart";
  if (!kind.empty()) all += ".";
  if (!what.empty()) all += " " + what + ".";
  std::string course = when.empty() || how.empty() ? when + how : when + "; " + how;
  if (!course.empty()) {
    course[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(course[0])));
    all += " " + course + ".";
  }
  if (gain)
    all +=
        " On held-out trials it removes " + share_removed(*gain) + " of the error above the noise.";
  return all + " Do not extrapolate.";
}

MissingForce infer_missing_force(Evaluator& evaluator, const FitSummary& model,
                                 const MissingForceOptions& options) {
  return Inference(evaluator, model, options).run();
}

}  // namespace pedicel::discrepancy
