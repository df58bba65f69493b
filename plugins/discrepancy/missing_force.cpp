#include "discrepancy/missing_force.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "discrepancy/evidence.h"
#include "discrepancy/force_course.h"
#include "discrepancy/force_term.h"
#include "discrepancy/places.h"
#include "discrepancy/sentence.h"
#include "discrepancy/way_back.h"

namespace pedicel::discrepancy {

namespace {

constexpr double enough_evidence = 8.0;  // nats, as a named cause must be worth
constexpr double clear_margin = 5.0;     // nats, of a sensor over a force
constexpr double as_well_within = 3.0;   // nats: odds of 20 to 1
constexpr std::size_t most_places = 14;
constexpr std::ptrdiff_t most_loud = 3;  // places where laws are tried, besides two of each curve
constexpr std::size_t most_refits = 5;
constexpr double refit_within = 30.0;  // nats of linear response, and
constexpr double refit_share = 0.3;    // of the best one's: large forces are not linear
constexpr std::size_t kinds = 11;
// A string's numbers stand for one another: a refit could go along its valley for long.
constexpr int most_iterations = 30;
constexpr double close_share = 0.05;  // of the best law's evidence
constexpr double place_share = 0.5;   // of the evidence, by which another place may be worse
constexpr std::size_t most_looks = 6;
constexpr int look_iterations = 5;

/// A place with what was found there.
struct Place {
  ForceSpace space;
  FreeForce free;
  ForcePath path;
};

class Inference {
 public:
  Inference(Evaluator& evaluator, const FitSummary& model, const MissingForceOptions& options)
      : evaluator_(evaluator),
        model_(model),
        options_(options),
        experiment_(evaluator.data().experiment()) {
    scales_.samples = evaluator.data().samples(options.fit.trials);
    for (const plant::PlantCurve& curve : experiment_.plant.curves)
      scales_.length = std::max(scales_.length, drawn_length(curve));
    for (const Trial& trial : experiment_.trials) {
      scales_.duration = std::max(scales_.duration, trial.duration());
      scales_.trials.push_back(trial.name);
    }
  }

  MissingForce run() {
    choose_centre();
    look_at_places();
    const bool of_sensor = look_at_sensor();
    if (of_sensor) {
      conclude_sensor();
    } else if (!places_.empty() && places_.front().free.evidence > options_.least_evidence) {
      try_laws();
      refit();
      conclude();
    }
    result_.simulations = responses_->simulations();
    return std::move(result_);
  }

 private:
  void note(const std::string& sentence) const {
    if (options_.note) options_.note(sentence);
  }

  // Markers spread over the plant.
  std::vector<int> markers() const {
    std::vector<int> all;
    for (const Chain& chain : chains_of(experiment_))
      for (std::size_t m = 0; m < chain.markers.size(); ++m)
        if (chain.arc[m] > 0.02 * chain.length) all.push_back(chain.markers[m]);
    if (all.size() <= most_places) return all;
    std::vector<int> chosen;
    for (std::size_t i = 0; i < most_places; ++i)
      chosen.push_back(all[i * (all.size() - 1) / (most_places - 1)]);
    return chosen;
  }

  double noise_cost() const { return 0.5 * scales_.samples; }

  // Where no number of the plant can stand for a force, it pulls them far away all the same: the
  // plant as it was believed to be answers more like the real one then.
  void choose_centre() {
    centre_ = model_;
    if (is_beyond_belief(model_)) {
      note("The refitted plant is beyond belief: forces act on the one that was believed in.");
      FitOptions none = options_.fit;
      none.iterations = 0;
      centre_ = fit(evaluator_, as_believed(model_.hypothesis), none);
      if (options_.correct_at) options_.correct_at(centre_);
    }
    const Simulator& simulator = evaluator_.simulator();
    const double distance = options_.response_distance > 0.0 ? options_.response_distance
                                                             : simulator.numerics().distance;
    responses_ =
        std::make_unique<ForceResponses>(experiment_, evaluator_.data(), centre_, options_.fit,
                                         distance, options_.threads, simulator.stop());
  }

  void look_at_places() {
    double most = 0.0;
    for (const int marker : markers()) {
      Place place;
      place.space = responses_->force_at(marker);
      place.free = free_history(place.space);
      place.path = responses_->path(place.space, place.free.value);
      most = std::max(most, place.free.gain);
      places_.push_back(std::move(place));
    }
    std::ranges::stable_sort(
        places_, [](const Place& a, const Place& b) { return a.free.evidence > b.free.evidence; });
    for (const Place& place : places_)
      note("A free force at " + place_text(place.space.place) +
           text(": evidence %.4g", place.free.evidence));
    scales_.dispersion = std::max(1.0, (centre_.cost - most) / noise_cost());
    scales_.choices = kinds * std::max<std::size_t>(1, places_.size());
  }

  // Whether markers that move by themselves explain the data better than any force does. One alone
  // could always have moved so.
  bool look_at_sensor() {
    if (experiment_.markers.size() < 2) return false;
    std::vector<std::vector<int>> groups{{}};
    for (int m = 0; m < static_cast<int>(experiment_.markers.size()); ++m) {
      groups.front().push_back(m);
      groups.push_back({m});
    }
    for (const std::vector<int>& group : groups) {
      const double evidence = free_history(responses_->displacement_of(group)).evidence;
      if (evidence <= sensor_evidence_) continue;
      sensor_evidence_ = evidence;
      sensor_ = group;
    }
    const double force = places_.empty() ? 0.0 : places_.front().free.evidence;
    note(text("A free displacement of markers: evidence %.4g", sensor_evidence_));
    return sensor_evidence_ > std::max(force, enough_evidence) + clear_margin;
  }

  void conclude_sensor() {
    result_.found = true;
    result_.kind = "sensor";
    result_.evidence = sensor_evidence_;
    result_.where = sensor_.size() > 1 ? "All markers move alike: the camera's frame or the base"
                                       : "Marker \"" + experiment_.markers[sensor_.front()].name +
                                             "\" moves on its own: the marker, not the plant";
    const FreeForce free = free_history(responses_->displacement_of(sensor_));
    result_.share = share_of(free.gain);
  }

  double share_of(double gain) const {
    return std::clamp(gain / std::max(1.0, model_.cost - noise_cost()), 0.0, 1.0);
  }

  void try_laws() {
    std::map<std::string, std::size_t> tried;  // places of each curve
    for (const Place& place : places_) {
      const bool loud = &place - places_.data() < most_loud;
      if (++tried[place.space.place.curve] > 2 && !loud) continue;
      const std::vector<ForceTerm> terms = regress_force(place.space, place.path, scales_);
      for (const ForceTerm& term : terms)
        note("  " + kind_of(term.force) + " at " + place_text(*term.force.place) +
             text(": evidence %.4g with %g numbers", term.evidence, term.parameters));
      terms_.insert(terms_.end(), terms.begin(), terms.end());
    }
    std::ranges::stable_sort(
        terms_, [](const ForceTerm& a, const ForceTerm& b) { return a.evidence > b.evidence; });
  }

  static const std::string& kind_of(const plant::Effect& force) { return force.words.at("kind"); }

  // What refits of one kind find for the other, too.
  static std::string family_of(const plant::Effect& force) {
    const std::string kind = plain_kind(force);
    return kind == "string" ? "stop" : kind;
  }

  // The best place of every kind, as long as it is not far behind; then, of the best kind, the best
  // place on every other curve. Simple laws first.
  std::vector<ForceTerm> worth_refitting() const {
    if (terms_.empty()) return {};
    const plant::Effect& first = terms_.front().force;
    const double best = terms_.front().evidence;
    const double least =
        std::max(0.5 * enough_evidence, std::min(best - refit_within, (1.0 - refit_share) * best));
    std::vector<ForceTerm> chosen;
    const auto take = [&](const ForceTerm& term, std::set<std::string>& known,
                          const std::string& what) {
      if (term.evidence > least && chosen.size() < most_refits && known.insert(what).second)
        chosen.push_back(term);
    };
    std::set<std::string> families, curves{first.place->curve};
    for (const ForceTerm& term : terms_) take(term, families, family_of(term.force));
    for (const ForceTerm& term : terms_)
      if (kind_of(term.force) == kind_of(first)) take(term, curves, term.force.place->curve);
    std::ranges::stable_sort(
        chosen, [](const ForceTerm& a, const ForceTerm& b) { return a.parameters < b.parameters; });
    return chosen;
  }

  Hypothesis with(const plant::Effect& force) const {
    Hypothesis start = centre_.hypothesis;
    const Place& place = nearest(*force.place);
    if (start.size() > 0)  // which have taken what they could of the force
      start.set_unknowns(start.unknowns() +
                         place.space.shift * history_of(force, place.space, place.path, scales_));
    start.add(free_force(force, 0.02 * scales_.length, scales_.duration));
    start.name = missing_force;
    return start;
  }

  // From the best of a few starts in each place where the same law does about as well: what is
  // stiff has ridges between places. A few iterations tell which one goes on.
  FitSummary refitted(const ForceTerm& term) {
    FitOptions few = options_.fit;
    few.iterations = std::min(most_iterations, few.iterations);
    std::vector<plant::Effect> places{term.force};
    for (const ForceTerm& other : terms_)
      if (kind_of(other.force) == kind_of(term.force) && !(other.force.place == term.force.place) &&
          other.force.place->curve == term.force.place->curve &&
          other.evidence > (1.0 - place_share) * term.evidence && places.size() < most_looks)
        places.push_back(other.force);
    if (places.size() == 1) return fit(evaluator_, best_start(term.force), few);
    FitOptions look = few;
    look.iterations = std::min(look_iterations, few.iterations);
    FitSummary best;
    for (const plant::Effect& force : places) {
      FitSummary found = fit(evaluator_, best_start(force), look);
      if (best.why == "not run" || found.cost < best.cost) best = std::move(found);
    }
    few.iterations -= look.iterations;
    return few.iterations > 0 ? discrepancy::refit(evaluator_, best, few) : best;
  }

  // What looks like a stop may be a string to a point at any distance.
  Hypothesis best_start(const plant::Effect& force) {
    std::vector<Hypothesis> starts;
    for (const double factor : {1.0, 0.5, 2.0}) {
      plant::Effect scaled = force;
      scale_force(scaled, factor);
      starts.push_back(with(scaled));
    }
    if (kind_of(force) == "string")
      for (const ForceTerm& stop : result_.terms)
        for (const double distance : {0.3, 0.6, 1.5})
          if (kind_of(stop.force) == "stop") {
            plant::Effect string = stop.force;
            string.words["kind"] = "string";
            string.numbers["distance"] = {distance * scales_.length};
            starts.push_back(with(string));
          }
    return starts[scan(evaluator_, starts, options_.fit).best];
  }

  void refit() {
    for (const ForceTerm& term : worth_refitting()) refit(term);
    if (result_.terms.empty()) return;
    sort_terms();
    for (const ForceTerm& term : close_ones())
      if (const std::optional<ForceTerm> other = with_other_end(term)) refit(*other);
    sort_terms();
    if (!options_.correct_at) return;
    options_.correct_at(result_.fit);
    result_.fit = discrepancy::refit(evaluator_, result_.fit, options_.fit);
    judge(result_.fit, result_.terms.front());
    result_.evidence = result_.terms.front().evidence;
  }

  void sort_terms() {
    std::ranges::stable_sort(result_.terms, std::greater(), &ForceTerm::evidence);
  }

  // A law that was left in a side valley may come out first by its other end.
  std::vector<ForceTerm> close_ones() const {
    const double least = (1.0 - close_share) * result_.terms.front().evidence;
    std::vector<ForceTerm> close;
    for (const ForceTerm& term : result_.terms)
      if (term.evidence >= least) close.push_back(term);
    return close;
  }

  // What a refit says about its law.
  void judge(const FitSummary& found, ForceTerm& term) const {
    term.gain = (model_.cost - found.cost) / scales_.dispersion;
    // One more: its place along the curve.
    term.evidence = term.gain - cost_of(term.parameters + 1, scales_.samples, scales_.choices);
    term.force = found.hypothesis.effects.back();
    note("Refitted: " + describe(term.force) + " at " + place_text(*term.force.place) +
         text(", evidence %.4g", term.evidence));
  }

  void refit(ForceTerm term) {
    const FitSummary found = refitted(term);
    judge(found, term);
    const bool better = result_.terms.empty() || term.evidence > result_.evidence;
    result_.terms.push_back(term);
    if (!better) return;
    result_.evidence = term.evidence;
    result_.fit = found;
  }

  // What pulls towards a far end is a stop or a constant push; its own kind, with an end that is
  // near, is tried there, too, so that it can be said whether the data tell them apart. So is a
  // stop in place of a string, which has more numbers.
  std::optional<ForceTerm> with_other_end(const ForceTerm& term) const {
    const bool is_string = kind_of(term.force) == "string";
    const std::string kind = is_string ? "stop" : kind_with_near_end(kind_of(term.force));
    const auto tried = [&](const ForceTerm& t) {
      return kind_of(t.force) == kind && t.force.place->curve == term.force.place->curve;
    };
    if (kind.empty() || std::ranges::any_of(result_.terms, tried)) return {};
    ForceTerm other = term;
    if (is_string) {
      other.force.words["kind"] = kind;
      other.force.numbers.erase("distance");
    } else {
      other.force = near_end(term.force, nearest(*term.force.place), 0.6 * scales_.length);
    }
    other.parameters = kind == "string" ? 5 : 3;
    return other;
  }

  static std::string kind_with_near_end(const std::string& kind) {
    return kind == "stop" ? "string" : kind == "constant" ? "spring" : "";
  }

  static plant::Effect near_end(plant::Effect force, const Place& place, double distance) {
    if (kind_of(force) == "constant") {
      const Vec3 push(force.numbers.at("force").data());
      const Vec3 about = place.path.position.front().row(0).transpose();
      const Vec3 tangent = place.space.axes[0].cross(place.space.axes[1]);
      const Vec3 towards = push.normalized();
      force.numbers.erase("force");
      force.numbers["about"] = {about.x(), about.y(), about.z()};
      force.numbers["towards"] = {towards.x(), towards.y(), towards.z()};
      force.numbers["tilt"] = {0.0, 0.0};
      force.numbers["axis"] = {tangent.x(), tangent.y(), tangent.z()};
      force.numbers["stiffness"] = {push.norm() / distance};
    }
    force.words["kind"] = kind_with_near_end(kind_of(force));
    force.numbers["distance"] = {distance};
    return force;
  }

  void conclude() {
    const Place& loudest = places_.front();
    if (result_.evidence >= enough_evidence) {
      const plant::Effect& force = result_.terms.front().force;
      result_.found = true;
      result_.kind = plain_kind(force);
      result_.place = force.place;
      result_.share = share_of(model_.cost - result_.fit.cost);
      result_.what = "It fits best as this: " + describe(force);
      describe_course(
          course_of_law(evaluator_.simulator(), result_.fit.hypothesis, options_.fit.trials),
          kind_of(force));
      find_elsewhere();
      find_other_kinds();
      check();
    } else if (loudest.free.evidence - (centre_.cost - model_.cost) >= enough_evidence) {
      result_.found = true;
      result_.kind = "force of no known law";
      result_.place = loudest.space.place;
      result_.evidence = loudest.free.evidence - (centre_.cost - model_.cost);
      result_.share = share_of(loudest.free.gain - (centre_.cost - model_.cost));
      result_.what = "No law of the library follows it";
      describe_course(course_of_history(loudest.space, loudest.path, loudest.free.value), "");
    }
    if (result_.found) result_.where = where_text();
  }

  // How well the place is known: along its curve, and on which one.
  void find_elsewhere() {
    const Hypothesis& model = result_.fit.hypothesis;
    for (int p = 0; p < model.size(); ++p)
      if (model.free[p].name == "at" && model.effects[model.free[p].effect].name == missing_force &&
          std::isfinite(result_.fit.standard_error[p]))
        result_.place_error =
            std::hypot(model.free[p].scale * result_.fit.standard_error[p], node_share());
    std::set<std::string> known{result_.place->curve};
    for (const ForceTerm& term : result_.terms)
      if (term.evidence > result_.evidence - as_well_within &&
          known.insert(term.force.place->curve).second)
        result_.elsewhere.push_back(*term.force.place);
  }

  // The deviation of a place that is only known to a node, of its curve's length: loud data would
  // know it better, were the law and the mesh exact.
  double node_share() const {
    for (const plant::PlantCurve& curve : experiment_.plant.curves)
      if (curve.name == result_.place->curve)
        return evaluator_.simulator().numerics().distance / std::sqrt(12.0) / drawn_length(curve);
    return 0.0;
  }

  void find_other_kinds() {
    const ForceTerm& best = result_.terms.front();
    std::set<std::string> known{result_.kind};
    for (const ForceTerm& term : result_.terms) {
      const bool near_end = kind_of(term.force) == kind_with_near_end(kind_of(best.force));
      const bool as_well = near_end ? term.gain > best.gain - as_well_within
                                    : term.evidence > best.evidence - as_well_within;
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

  const Place& nearest(const plant::CurvePlace& at) const {
    const Place* best = &places_.front();
    const auto distance = [&](const Place& p) {
      return (p.space.place.curve == at.curve ? 0.0 : 10.0) + std::abs(p.space.place.at - at.at);
    };
    for (const Place& place : places_)
      if (distance(place) < distance(*best)) best = &place;
    return *best;
  }

  static std::string place_text(const plant::CurvePlace& place) {
    return place.curve + text(" at %.2g of its length", place.at);
  }

  void describe_course(const ForceCourse& course, const std::string& kind) {
    result_.when = when_it_acts(course, kind);
    result_.how = what_it_does(course);
  }

  // RMS error in noise units over the trials kept back, without and with the force.
  void check() {
    if (options_.check.empty()) return;
    FitOptions kept = options_.fit;
    kept.trials = options_.check;
    const std::vector<Hypothesis> models{model_.hypothesis, result_.fit.hypothesis};
    const auto predicted = evaluator_.predictions(models, kept);
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
    note(text("Trials kept back: %.4g of the noise without it, %.4g with it", error[0], error[1]));
    if (error[0] > 1.0) result_.gain = (error[0] - error[1]) / (error[0] - 1.0);
  }

  Evaluator& evaluator_;
  const FitSummary& model_;
  const MissingForceOptions& options_;
  const Experiment& experiment_;
  FitSummary centre_;  ///< the model about which forces act: `model_`, or what it was pulled from
  std::unique_ptr<ForceResponses> responses_;
  LibraryScales scales_;
  std::vector<Place> places_;
  std::vector<int> sensor_;
  double sensor_evidence_ = 0.0;
  std::vector<ForceTerm> terms_;
  MissingForce result_;
};

}  // namespace

std::string MissingForce::sentence() const {
  if (!found) return "";
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
  if (gain) all += text(" On trials kept back it removes %.0f %% of the error.", 100.0 * *gain);
  return all + " Do not extrapolate.";
}

MissingForce infer_missing_force(Evaluator& evaluator, const FitSummary& model,
                                 const MissingForceOptions& options) {
  return Inference(evaluator, model, options).run();
}

}  // namespace pedicel::discrepancy
