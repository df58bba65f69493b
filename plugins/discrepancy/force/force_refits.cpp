#include "plugins/discrepancy/force/force_refits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ranges>
#include <set>
#include <utility>

#include "plugins/discrepancy/data/places.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/discrepancy/simulate/force_term.h"

namespace pedicel::discrepancy {

namespace {

// A spring as strong as the push at a distance of the end, so that the refit begins where the push
// was.
plant::Effect near_end(plant::Effect force, const ForcePlace& place, double distance) {
  // A stop has its point and direction already; a push has neither.
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

// A stop pushes across the curve, where a string may lean along it.
plant::Effect as_stop(plant::Effect string, double least_across) {
  const Vec3 axis = Vec3(string.numbers.at("axis").data()).normalized();
  const Vec3 pull = direction_of(string);
  const Vec3 across = pull - axis.dot(pull) * axis;
  // A string along the curve has no direction across it: the stop keeps the one that it had.
  if (across.norm() > least_across) {
    const Vec3 n = across.normalized();
    string.numbers["towards"] = {n.x(), n.y(), n.z()};
    string.numbers["tilt"] = {0.0, 0.0};
  }
  string.words["kind"] = "stop";
  string.numbers.erase("distance");
  return string;
}

// m, W, of a place of a curve at each sample, between the markers beside it.
Eigen::MatrixXd path_at(const MarkerChain& chain, double at, const Eigen::MatrixXd& markers) {
  const auto path = [&](std::size_t i) { return markers.middleCols(3L * chain.markers[i], 3); };
  const double arc = at * chain.length;
  const auto above =
      static_cast<std::size_t>(std::ranges::lower_bound(chain.arc, arc) - chain.arc.begin());
  if (above == 0) return path(0);
  if (above == chain.arc.size()) return path(above - 1);
  const double share = (arc - chain.arc[above - 1]) / (chain.arc[above] - chain.arc[above - 1]);
  return (1.0 - share) * path(above - 1) + share * path(above);
}

// A stop in other places of its curve: at the markers and midway between them. It begins where the
// place is when the stop that was found begins, and pushes as much.
std::vector<plant::Effect> stops_along(const plant::Effect& stop, const MarkerChain& chain,
                                       std::span<const Prediction> motion) {
  std::vector<double> others;
  for (std::size_t i = 0; i < chain.arc.size(); ++i) {
    others.push_back(chain.arc[i] / chain.length);
    if (i > 0) others.push_back(0.5 * (chain.arc[i - 1] + chain.arc[i]) / chain.length);
  }
  const Vec3 n = direction_of(stop), about(stop.numbers.at("about").data());
  const double begins = n.dot(about) - stop.number("offset");
  std::vector<plant::Effect> moved;
  for (const double at : others) {
    Vec3 sum = Vec3::Zero();
    double depth = 0.0;
    std::vector<double> heights;  // along n, while the stop acts
    for (const Prediction& trial : motion) {
      const Eigen::MatrixXd here = path_at(chain, stop.place->at, trial.markers);
      const Eigen::MatrixXd there = path_at(chain, at, trial.markers);
      for (long k = 0; k < here.rows(); ++k) {
        const double in = begins - here.row(k).dot(n);
        // Not of a simulation that failed.
        if (!(in > 0.0) || !there.row(k).allFinite()) continue;
        depth += in;
        sum += there.row(k).transpose();
        heights.push_back(there.row(k).dot(n));
      }
    }
    if (heights.empty()) continue;
    std::ranges::sort(heights);
    // Not the highest of all: of a swing that comes in elsewhere one sample may stand far out.
    const double face = heights[heights.size() * 9 / 10];
    double depth_there = 0.0;
    for (const double height : heights) depth_there += std::max(0.0, face - height);
    if (depth_there <= 0.0) continue;
    const Vec3 mean = sum / static_cast<double>(heights.size());
    const Vec3 to = mean + (face - mean.dot(n)) * n;
    plant::Effect there = stop;
    there.place->at = at;
    there.numbers["about"] = {to.x(), to.y(), to.z()};
    there.numbers["offset"] = {0.0};
    scale_force(there, depth / depth_there);
    moved.push_back(std::move(there));
  }
  return moved;
}

}  // namespace

std::string place_text(const plant::CurvePlace& place) {
  return place.curve + text(" at %.2g of its length", place.at);
}

std::string kind_with_near_end(const std::string& kind) {
  // Others have no end, or have it near already.
  return kind == "stop" ? "string" : kind == "constant" ? "spring" : "";
}

ForceRefits::ForceRefits(Evaluator& evaluator, const FitSummary& model, const FitSummary& centre,
                         std::span<const ForcePlace> places, const LibraryScales& scales,
                         const MissingForceOptions& options)
    : evaluator_(evaluator),
      model_(model),
      centre_(centre),
      places_(places),
      scales_(scales),
      options_(options),
      budget_(options.fit.settings->budget) {}

void ForceRefits::run(std::vector<ForceTerm> laws) {
  // All of them are kept: other places of a law are starts of its refit.
  linear_ = std::move(laws);
  // Each takes a fit of all numbers by the fine simulator, so only the best go in.
  for (const ForceTerm& law : worth_refitting()) refit(law);
  if (refitted_.empty()) return;
  sort();
  for (const ForceTerm& law : close_ones())
    // After all first ones, so that it is known which of them are near the best.
    if (const std::optional<ForceTerm> other = with_other_end(law)) refit(*other);
  sort();
  // Corrections were taken at a model without the force. What won is fitted once more with those of
  // its own.
  if (!options_.correct_at) return;
  options_.correct_at(best_);
  // Only what is told is fitted again. The others keep what they gained with the old ones.
  best_ = discrepancy::refit(evaluator_, best_, options_.fit);
  judge(best_, refitted_.front());
}

void ForceRefits::sort() {
  std::ranges::stable_sort(refitted_, std::greater(), &ForceTerm::evidence);
}

// The best place of every kind, as long as it is not far behind; then, of the best kind, the best
// place on every other curve. Simple laws first.
std::vector<ForceTerm> ForceRefits::worth_refitting() const {
  if (linear_.empty()) return {};
  const plant::Effect& first = linear_.front().force;
  const double best = linear_.front().evidence;
  // Linear evidence errs by a part of itself: the limit is a share of the best for large forces,
  // and some nats for small ones. Weak laws are not refitted however near the best they are.
  const double least = std::max(
      budget_.law_evidence, std::min(best - budget_.law_within, (1.0 - budget_.law_share) * best));
  std::vector<ForceTerm> chosen;
  const auto take = [&](const ForceTerm& law, std::set<std::string>& known,
                        const std::string& what) {
    if (law.evidence > least && std::cmp_less(chosen.size(), budget_.law_refits) &&
        known.insert(what).second)
      chosen.push_back(law);
  };
  // Another place of one kind is found by the refit itself, along the curve; another curve is not.
  std::set<std::string> kinds, curves{first.place->curve};
  for (const ForceTerm& law : linear_) take(law, kinds, kind_of(law.force));
  for (const ForceTerm& law : linear_)
    if (kind_of(law.force) == kind_of(first)) take(law, curves, law.force.place->curve);
  std::ranges::stable_sort(
      chosen, [](const ForceTerm& a, const ForceTerm& b) { return a.parameters < b.parameters; });
  return chosen;
}

void ForceRefits::refit(ForceTerm law) {
  FitSummary found = fitted(law);
  judge(found, law);
  // All that were refitted are kept: the verdict says which others do as well. By evidence: a law
  // with more numbers has to earn them.
  const bool better = refitted_.empty() || law.evidence > best_evidence_;
  refitted_.push_back(law);
  if (!better) return;
  best_evidence_ = law.evidence;
  best_ = std::move(found);
}

// From the best of a few starts in each place where the same law does about as well: what is
// stiff has ridges between places. A few iterations tell which one goes on.
FitSummary ForceRefits::fitted(const ForceTerm& law) {
  FitOptions few = options_.fit;
  // Laws with a threshold never quite converge.
  few.iterations = std::min(budget_.law_iterations, few.iterations);
  std::vector<plant::Effect> places{law.force};
  for (const ForceTerm& other : linear_)
    if (kind_of(other.force) == kind_of(law.force) && !(other.force.place == law.force.place) &&
        other.force.place->curve == law.force.place->curve &&
        other.evidence > (1.0 - budget_.law_place_share) * law.evidence &&
        std::cmp_less(places.size(), budget_.law_looks))
      places.push_back(other.force);
  // One place needs no look, and goes all the way at once.
  if (places.size() == 1) return fit(evaluator_, best_start(law.force), few);
  FitOptions look = few;
  look.iterations = std::min(budget_.look_iterations, few.iterations);
  FitSummary best;
  for (const plant::Effect& force : places) {
    FitSummary found = fit(evaluator_, best_start(force), look);
    // Of one kind with as many numbers, so costs alone decide.
    if (best.why == "not run" || found.cost < best.cost) best = std::move(found);
  }
  FitOptions rest = few;
  // What the look has taken counts: no kind gets more iterations than another.
  rest.iterations -= look.iterations;
  if (rest.iterations > 0) best = discrepancy::refit(evaluator_, best, rest);
  return kind_of(law.force) == "stop" ? moved_along(std::move(best), few) : best;
}

// A hard stop leaves a valley at every node, and a fit does not climb from one to the next. So the
// stop that was found is tried in the other places, too.
FitSummary ForceRefits::moved_along(FitSummary found, const FitOptions& few) {
  // Where it leaves little but noise there is nothing that another place could explain.
  if (found.cost < scales_.samples) return found;
  const plant::Effect stop = found.hypothesis.effects.back();
  const Experiment& experiment = evaluator_.data().experiment();
  const std::vector<MarkerChain> chains = chains_of(experiment);
  const auto chain = std::ranges::find_if(chains, [&](const MarkerChain& one) {
    const auto curve = static_cast<std::size_t>(one.curve);
    return experiment.plant().curves[curve].name == stop.place->curve;
  });
  // By what the fit foretells of the markers, which is near the data by now.
  const auto motion = evaluator_.predictions(std::vector{found.hypothesis}, options_.fit);
  std::vector<Hypothesis> starts;
  for (const plant::Effect& moved : stops_along(stop, *chain, motion.front()))
    // How hard it is there is known to a factor: markers say where the plant was, not the force.
    for (const double factor : {0.5, 1.0, 2.0}) {
      Hypothesis start = found.hypothesis;
      start.effects.back() = moved;
      scale_force(start.effects.back(), factor);
      starts.push_back(std::move(start));
    }
  if (starts.empty()) return found;
  const Scan seen = scan(evaluator_, starts, options_.fit);
  std::map<double, std::size_t> best_at;  // the best start of each place
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto [known, is_new] = best_at.try_emplace(starts[i].effects.back().place->at, i);
    if (!is_new && seen.cost[i] < seen.cost[known->second]) known->second = i;
  }
  std::vector<std::size_t> order;
  for (const auto& [at, i] : best_at) order.push_back(i);
  std::ranges::sort(order, {}, [&](std::size_t i) { return seen.cost[i]; });
  // All the way: in its first iterations a hard stop in its right place is worse than a soft one
  // elsewhere.
  for (const std::size_t i : order | std::views::take(budget_.stop_moves)) {
    FitSummary other = fit(evaluator_, starts[i], few);
    if (other.cost < found.cost) found = std::move(other);
  }
  return found;
}

// What looks like a stop may be a string to a point at any distance.
Hypothesis ForceRefits::best_start(const plant::Effect& force) {
  std::vector<Hypothesis> starts;
  // The linear size is off where the plant bends far. Three tries are one batch of simulations.
  for (const double factor : {1.0, 0.5, 2.0}) {
    plant::Effect scaled = force;
    scale_force(scaled, factor);
    starts.push_back(with(scaled));
  }
  if (kind_of(force) == "string")
    for (const ForceTerm& stop : refitted_)
      // The linear library finds a far end only: along a short path all distances pull alike.
      for (const double distance : {0.3, 0.6, 1.5})
        if (kind_of(stop.force) == "stop") {
          plant::Effect string = stop.force;
          string.words["kind"] = "string";
          string.numbers["distance"] = {distance * scales_.length};
          starts.push_back(with(string));
        }
  // By the simulator itself, all starts side by side.
  return starts[scan(evaluator_, starts, options_.fit).best];
}

Hypothesis ForceRefits::with(const plant::Effect& force) const {
  // About the centre, where the linear response was taken and the law is right.
  Hypothesis start = centre_.hypothesis;
  // The law's place may lie between markers. Its history is known at the nearest one.
  const ForcePlace& place = nearest(*force.place);
  if (start.size() > 0)  // which have taken what they could of the force
    start.set_unknowns(start.unknowns() +
                       place.space.shift * history_of(force, place.space, place.path, scales_));
  // The place along the curve is free, too: the true one may lie between markers.
  start.add(free_force(force, 0.02 * scales_.length, scales_.duration));
  start.name = missing_force;
  return start;
}

// What a refit says about its law.
void ForceRefits::judge(const FitSummary& found, ForceTerm& law) const {
  // From the model without a force, refitted: what its numbers could explain is not the law's.
  law.gain = (model_.cost - found.cost) / scales_.dispersion;
  // One more: its place along the curve.
  law.evidence = law.gain - cost_of(law.parameters + 1, scales_.samples, scales_.choices);
  // As it was fitted, with its place. It was added last.
  law.force = found.hypothesis.effects.back();
  // Each as it comes, because a search for a force takes minutes.
  if (options_.note)
    options_.note("Refitted: " + describe(law.force) + " at " + place_text(*law.force.place) +
                  text(", evidence %.4g", law.evidence));
}

// A law that was left in a side valley may come out first by its other end.
std::vector<ForceTerm> ForceRefits::close_ones() const {
  const double least = (1.0 - budget_.law_close_share) * refitted_.front().evidence;
  std::vector<ForceTerm> close;
  for (const ForceTerm& law : refitted_)
    // A share of it, since large gains are missed by more nats.
    if (law.evidence >= least) close.push_back(law);
  return close;
}

// What pulls towards a far end is a stop or a constant push; its own kind, with an end that is
// near, is tried there, too, so that it can be said whether the data tell them apart. So is a
// stop in place of a string, which has more numbers.
std::optional<ForceTerm> ForceRefits::with_other_end(const ForceTerm& law) const {
  const bool is_string = kind_of(law.force) == "string";
  const std::string kind = is_string ? "stop" : kind_with_near_end(kind_of(law.force));
  const auto tried = [&](const ForceTerm& other) {
    return kind_of(other.force) == kind && other.force.place->curve == law.force.place->curve;
  };
  // Once a curve is enough: the refit walks along it.
  if (kind.empty() || std::ranges::any_of(refitted_, tried)) return {};
  ForceTerm other = law;
  // Its gain is still that of the other law. refit() judges it anew.
  other.force = is_string ? as_stop(law.force, options_.fit.settings->accuracy.least_across)
                          : near_end(law.force, nearest(*law.force.place),
                                     options_.fit.settings->accuracy.far_end * scales_.length);
  // Two angles, offset, distance and stiffness of a string; a stop and a spring have three numbers.
  other.parameters = kind == "string" ? 5 : 3;
  return other;
}

const ForcePlace& ForceRefits::nearest(const plant::CurvePlace& at) const {
  return *std::ranges::min_element(places_, std::less(), [&](const ForcePlace& place) {
    const plant::CurvePlace& there = place.space.place;
    // Ten lengths: another curve is farther than any place of the same one.
    return (there.curve == at.curve ? 0.0 : 10.0) + std::abs(there.at - at.at);
  });
}

}  // namespace pedicel::discrepancy
