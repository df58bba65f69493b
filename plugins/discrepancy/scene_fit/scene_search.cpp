#include "plugins/discrepancy/scene_fit/scene_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>

#include "engine/io/csv.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// The Bayesian information criterion, halved: each number costs 1/2 ln n nats.
double cost_of(const FitSummary& fit) {
  // The verdict tells this as evidence. The search itself weighs by score(), because two solvers
  // differ by more than nats count.
  return 0.5 * fit.misfit().square +
         0.5 * fit.hypothesis.size() *
             std::log(std::max(2.0, static_cast<double>(fit.misfit().count)));
}

double square(double x) {
  return x * x;
}

double excess_of(double cost, const Misfit& sum) {
  // A cost is half of a sum of squares.
  return SceneDataSet::beyond_noise({2.0 * cost, sum.count});
}

// Effects of the baseline that left what the files say: beyond what their numbers are sure of, and
// what a ruler says.
std::vector<std::string> moved(const FitSummary& fit, const SceneSearchSettings& how) {
  std::vector<std::string> names;
  for (int p = 0; p < fit.hypothesis.size(); ++p) {
    const effects::FreeParameter& free = fit.hypothesis.free[static_cast<std::size_t>(p)];
    const plant::Effect& effect = fit.hypothesis.effects[static_cast<std::size_t>(free.effect)];
    // Once each, however many of its components went.
    if (!told_of_baseline(effect, free) || std::ranges::find(names, effect.name) != names.end())
      continue;
    const double error = std::hypot(fit.standard_error[p] * free.scale, how.least_displacement);
    // Its files' value is zero, so the number itself is how far it went.
    if (std::abs(fit.hypothesis.value(p)) > how.named_deviations * error)
      names.push_back(effect.name);
  }
  return names;
}

// Damping is what solvers differ by most, and density is seen through little but weight.
// However sharp the data are, two solvers make this much of one number. It is added to the fit's
// own error.
double allowance(const plant::MaterialKey& number, const SceneSearchSettings& how) {
  return number.role == plant::MaterialRole::damping ? how.damping_known_to
         : number.role == plant::MaterialRole::mass  ? how.density_known_to
                                                     : how.modulus_known_to;
}

// Whether trials that a model was not fitted to agree with it.
bool holds_elsewhere(const std::optional<double>& excess, const std::optional<double>& nominal,
                     const SceneSearchSettings& how) {
  return !excess || !nominal ||
         *excess <= how.held_out_allowance * std::max(how.floor, how.solvers_share * *nominal);
}

// 1, relative: how well a plant's file says it knows a number of its material; 0: it does not say.
double stated_of(const Experiment& experiment, const plant::MaterialKey& number) {
  double most = 0.0;
  // The largest of several plants: a factor is on all of them.
  for (const ExperimentPlant& plant : experiment.plants)
    most = std::max(most, plant::stated_knowledge(plant.file.material, number));
  return most;
}

// Of several starts of a cause, and of several joints, cameras or sensors, the best stands for
// it.
std::vector<ScreenedCause> best_of_each(const std::vector<ScreenedCause>& screened) {
  std::map<std::string, int> seen;
  std::vector<ScreenedCause> kept;
  for (const ScreenedCause& one : screened)
    // They are in order, so the first is the best.
    if (seen[one.name]++ == 0) kept.push_back(one);
  return kept;
}

// The best start of each cause, then the next best of each.
std::vector<ScreenedCause> in_turns(const std::vector<ScreenedCause>& screened) {
  std::map<std::string, int> seen;
  std::multimap<int, ScreenedCause> turns;
  // A cause with many joints and starts would else take all the places, and others would never be
  // simulated.
  for (const ScreenedCause& one : screened) turns.emplace(seen[one.name]++, one);
  std::vector<ScreenedCause> sorted;
  for (auto& [turn, one] : turns) sorted.push_back(std::move(one));
  return sorted;
}

// Whether the data are where one model puts them, on the way to what another one foretells.
// By how much worse the other is does not say so, since two solvers differ by more. But were the
// other right, what solvers differ by would have to look just as the two models differ.
// `numbers`: of the first one's own, beside the baseline's.
bool speaks_for(const FitSummary& one, const FitSummary& other, int numbers,
                const SceneSearchSettings& how) {
  const Between data = between(one, other);
  const double limit = how.named_deviations * data.error, square_error = square(data.error);
  // A fit takes one of the noise's squares for each number of its own, give or take as chi squared
  // does, and leads the data towards it: a bias of six numbers did so where a light load was the
  // truth.
  const double led = numbers * square_error, unsure = std::sqrt(1.0 + 2.0 * numbers * square_error);
  return std::abs(data.at) < limit && 1.0 - data.at > limit * unsure + led;
}

// Numbers beside the causes that left what is known of them.
std::vector<std::string> material_of(const FitSummary& fit, const Experiment& experiment,
                                     const SceneSearchSettings& how) {
  std::vector<std::string> names;
  // A number of the plant that goes far in a fit that explains the data is a finding beside the
  // cause, and not its price.
  for (const effects::EffectDefinition* one : effects::material_factors()) {
    const int p = fit.hypothesis.factor_on(one->name);
    if (p < 0) continue;
    const double off = std::log(fit.hypothesis.value(p));
    const double error = std::hypot(fit.standard_error[p], allowance(*one->material, how),
                                    stated_of(experiment, *one->material));
    // In logarithms: a factor of two and one of a half are equally far off.
    if (std::abs(off) > how.named_deviations * error) names.push_back(one->name);
  }
  for (const std::string& name : moved(fit, how)) names.push_back(name);
  return names;
}

// Whether one cause is what another one goes over into: a weak stretch without a length is a soft
// root.
bool is_case_of(const std::string& special, const std::string& general) {
  if (effects::is_special_case(special, general)) return true;
  const effects::EffectDefinition* known = effects::find_effect(general);
  return known && std::ranges::any_of(known->limits, [&](const effects::Limit& limit) {
           return limit.becomes == special;
         });
}

// The same of two models that have all other causes in common.
bool is_case_of(const std::vector<std::string>& special, const std::vector<std::string>& general) {
  const auto without = [](std::vector<std::string> names, const std::vector<std::string>& others) {
    std::erase_if(names, [&](const std::string& name) {
      return std::ranges::find(others, name) != others.end();
    });
    return names;
  };
  const std::vector<std::string> own = without(special, general), other = without(general, special);
  return own.size() == 1 && other.size() == 1 && is_case_of(own.front(), other.front());
}

class Search {
 public:
  Search(SceneEvaluator& evaluator, const SceneSearchOptions& options)
      : evaluator_(evaluator),
        options_(options),
        how_(evaluator.settings().search),
        experiment_(evaluator.simulator().experiment()) {}

  SceneFindings run() {
    tell("simulating the scene as the files say", 0.0);
    const Hypothesis plain;
    // First of all: shares and verdicts are told against what the files say.
    const FitSummary nominal = looked_at(plain);
    found_.nominal_excess = SceneDataSet::beyond_noise(nominal.misfit());
    found_.nominal_check = held_out(plain);
    tell("fitting modulus, density and damping", 0.05);
    found_.baseline = fit(first_baseline(), how_.baseline_iterations, options_.trials);
    // With a place among its numbers (the three are modulus, density and damping) a baseline has a
    // long way, and everything after is judged against it.
    if (!found_.baseline.converged && found_.baseline.hypothesis.size() > 3)
      found_.baseline = fit(found_.baseline.hypothesis, how_.baseline_iterations, options_.trials);
    follow_pushes();
    judge_baseline();
    renew_at_baseline();
    look_for_causes();
    refit_without_each();
    conclude();
    found_.partial = stopped();
    return std::move(found_);
  }

 private:
  // A plant that is not seen may stand where no derivative shows the way: when it is touched, or
  // whether, decides. So it is put to several places first.
  Hypothesis first_baseline() {
    std::vector<Hypothesis> starts = {scene_baseline(experiment_, evaluator_.settings())};
    const double far = how_.farthest_start;
    for (std::size_t p = 0; p < starts.front().free.size(); ++p) {
      const effects::FreeParameter& free = starts.front().free[p];
      const plant::Effect& effect = starts.front().effects[static_cast<std::size_t>(free.effect)];
      const SceneEffectDefinition* known = told_of_baseline(effect, free);
      // The definition says which components have no slope where nothing is touched.
      if (!known || free.component >= known->in_baseline->without_slope) continue;
      // One component at a time. All pairs would be dozens of simulations, and a fit goes on from
      // the best.
      for (const double way : {-far, -far / 2.0, -far / 4.0, far / 4.0, far / 2.0, far}) {
        starts.push_back(starts.front());
        starts.back().set_value(static_cast<int>(p), way);
      }
    }
    // Every plant is seen.
    if (starts.size() == 1) return starts.front();
    const Eigen::MatrixXd left = evaluator_.residuals(starts, evaluator_.options(options_.trials));
    long best = 0;
    // All at once, one simulation a place. The fit goes on from the best one.
    left.colwise().squaredNorm().minCoeff(&best);
    return starts[static_cast<std::size_t>(best)];
  }

  // Where an unseen plant stands along the tool is a valley: its sides, when the tool touches, are
  // so much steeper than its floor that a fit ends anywhere in it. By the wrench's moment the place
  // of the push is known beforehand, so the plant is put there.
  void follow_pushes() {
    if (!options_.push_shift) return;
    for (int again = 0; again < how_.renewals && !stopped(); ++again) {
      Hypothesis moved = found_.baseline.hypothesis;
      std::vector<int> places;
      for (int p = 0; p < moved.size(); ++p) {
        const effects::FreeParameter& free = moved.free[static_cast<std::size_t>(p)];
        const plant::Effect& effect = moved.effects[static_cast<std::size_t>(free.effect)];
        const SceneEffectDefinition* known = told_of_baseline(effect, free);
        if (known && free.component < known->in_baseline->without_slope) places.push_back(p);
      }
      // Of several unseen plants it is not known which one was pushed.
      if (places.empty() || places.size() > 2) return;
      const Vec3 shift = options_.push_shift(moved.effects);
      if (shift.norm() < how_.least_displacement) return;
      for (const int p : places)
        moved.set_value(p,
                        moved.value(p) + shift[moved.free[static_cast<std::size_t>(p)].component]);
      FitSummary next = fit(moved, how_.baseline_iterations, options_.trials);
      if (next.misfit().square >= found_.baseline.misfit().square) return;
      found_.baseline = std::move(next);
    }
  }

  void judge_baseline() {
    found_.baseline_cost = cost_of(found_.baseline);
    found_.baseline_excess = SceneDataSet::beyond_noise(found_.baseline.misfit());
    found_.baseline_check = held_out(found_.baseline.hypothesis);
  }

  // Misfits can be compared only under one noise.
  void renew_noise(const std::vector<plant::Effect>& effects) {
    // What was told of the files' own model counts under the new noise, too: shares are of it.
    options_.renew_noise(effects);
    const Hypothesis plain;
    found_.nominal_excess = SceneDataSet::beyond_noise(evaluator_.misfit(plain, options_.trials));
    found_.nominal_check = held_out(plain);
  }

  // An unseen plant's place is part of the baseline, and with it when the tool touches: what
  // predictions do not know of themselves was taken at other times.
  void renew_at_baseline() {
    // More than modulus, density and damping: a place is among them.
    if (!options_.renew_noise || found_.baseline.hypothesis.size() <= 3) return;
    // What leaves nothing needs no other noise.
    if (found_.baseline_excess <= how_.floor) return;
    for (int again = 0; again < how_.renewals && !stopped(); ++again) {
      const double before = found_.baseline_excess;
      renew_noise(found_.baseline.hypothesis.effects);
      found_.baseline = fit(found_.baseline.hypothesis, how_.baseline_iterations, options_.trials);
      judge_baseline();
      if (found_.baseline_excess <= how_.floor ||
          // Where it hardly helped any more, the noise is that of the right touches by now.
          found_.baseline_excess > how_.renewed_share * before)
        return;
    }
  }

  // A cause moves touches, too. Where the best leaves too much, all are judged again with the noise
  // of its predictions, and those that came near are fitted on.
  void renew_at_best() {
    if (!options_.renew_noise || found_.candidates.empty() || stopped()) return;
    const SceneCandidate& best = found_.candidates.front();
    // One that leaves most of the misfit is not the cause, and its touches are no better than the
    // files'.
    if (is_enough(best) || best.excess > how_.halfway * found_.baseline_excess) return;
    // What was far behind under the old noise is only told under the new one. Fitting it on would
    // cost as much as the best.
    const double near = how_.behind * std::max(best.excess, allowed());
    tell("taking the noise of predictions anew", 0.55);
    const std::vector<plant::Effect> effects = best.fit.hypothesis.effects;
    renew_noise(effects);
    // Not fitted again: it only has to be judged under the same noise as the others.
    found_.baseline = looked_at(found_.baseline.hypothesis);
    judge_baseline();
    // All, for the same reason as the baseline: two noises cannot be compared.
    for (SceneCandidate& one : found_.candidates) {
      if (stopped()) return;
      one.fit = one.excess <= near ? fit(one.fit.hypothesis, how_.last_iterations, options_.trials)
                                   : looked_at(one.fit.hypothesis);
      judge(one);
    }
    sort_candidates();
  }

  void look_for_causes() {
    if (stopped()) return;
    add_round(found_.baseline, found_.baseline_excess, {}, 0.2, 0.55);
    renew_at_best();
    for (int more = 1; more < how_.causes && !stopped(); ++more) {
      if (found_.candidates.empty()) return;
      // A copy: the next round sorts the list that it stands in.
      const SceneCandidate best = found_.candidates.front();
      // The second round has not found a better one, so a third would look at the same models.
      if (static_cast<int>(best.names.size()) < more || is_enough(best)) return;
      add_round(best.fit, best.excess, best.names, 0.55, 0.9);
      renew_at_best();
    }
  }

  // What a model may leave: two honest solvers differ by so much.
  double allowed() const {
    // A share of the misfit as well, since solvers differ by more where more moves. Of the larger
    // one of the two, so that a baseline that took over much of a cause leaves it no less room.
    return std::max(how_.floor,
                    how_.solvers_share * std::max(found_.nominal_excess, found_.baseline_excess));
  }
  bool is_enough(const SceneCandidate& one) const {
    // Both must hold: fitted trials alone would let many numbers win.
    return one.excess <= allowed() && holds_elsewhere(one.check_excess, found_.nominal_check, how_);
  }

  // Extends a model by each cause that it has not; refits those with the least linear cost.
  void add_round(const FitSummary& base, double base_excess, const std::vector<std::string>& names,
                 double from, double to) {
    tell("looking at all causes", from);
    // Beside the baseline, once: detectable limits are asked of the data and not of a model.
    std::vector<SeenFrom>* seen = found_.seen.empty() ? &found_.seen : nullptr;
    std::vector<ScreenedCause> screened =
        screen_causes(evaluator_, base, names, options_.trials, seen);
    // The linear cost is mostly too good. A cause that would not even gain enough by it is not
    // worth a fit.
    std::erase_if(screened, [&](const ScreenedCause& one) {
      return square(base_excess) - square(excess_of(one.linear_cost, base.misfit())) <
             how_.least_gain;
    });
    screened = best_of_each(tried(screened));
    double best = base_excess;
    std::size_t done = 0;
    // A second cause is looked for on top of one that has explained much.
    const auto most = static_cast<std::size_t>(names.empty() ? how_.refits : (how_.refits + 1) / 2);
    // Who does them elsewhere does all that may be asked for at once. What is kept is the same.
    std::vector<FitSummary> fits =
        fitted_elsewhere(std::span(screened).first(std::min(most, screened.size())), base_excess);
    for (const ScreenedCause& one : screened) {
      if (done == most || stopped()) break;
      // They are in order, so all that follow are farther behind.
      if (done > 0 &&
          excess_of(one.linear_cost, base.misfit()) > how_.behind * std::max(best, allowed()))
        break;
      tell(
          "refitting with " + one.name,
          from + (to - from) * (0.3 + 0.5 * static_cast<double>(done) / static_cast<double>(most)));
      found_.candidates.push_back(candidate_of(
          one, names, fits.empty() ? refitted(one, base_excess) : std::move(fits[done])));
      best = std::min(best, found_.candidates.back().excess);
      ++done;
    }
    sort_candidates();
    tell("refitting with causes of fewer numbers", from + 0.8 * (to - from));
    refit_plainer(std::span(screened).subspan(done), names, base_excess, most);
    keep_best_of_each();
  }

  // Extended by a cause that was looked at in the linear.
  FitSummary refitted(const ScreenedCause& one, double base_excess) {
    // From where the linear put all numbers, the base's among them.
    FitSummary found = fit(one.model, how_.first_iterations, options_.trials);
    const double excess = SceneDataSet::beyond_noise(found.misfit());
    // Where it leaves too much it may not have arrived, unless it leaves most of it.
    if (!found.converged && excess > allowed() && excess < how_.halfway * base_excess && !stopped())
      found = fit(found.hypothesis, how_.last_iterations, options_.trials);
    return found;
  }

  // By other processes; empty where there are none.
  std::vector<FitSummary> fitted_elsewhere(std::span<const ScreenedCause> causes,
                                           double base_excess) {
    if (!options_.parts || causes.empty()) return {};
    return fits_by(options_.parts, "causes", static_cast<int>(causes.size()), [&](int i) {
      return refitted(causes[static_cast<std::size_t>(i)], base_excess);
    });
  }

  // Kept also where it does badly, for what is told of causes that came near.
  SceneCandidate candidate_of(const ScreenedCause& one, std::vector<std::string> names,
                              FitSummary found) {
    SceneCandidate candidate;
    candidate.names = std::move(names);
    candidate.names.push_back(one.name);
    candidate.fit = std::move(found);
    judge(candidate);
    return candidate;
  }

  // The more numbers a cause has, the more of anything its linear prediction takes. So those with
  // fewer numbers than the best are judged by a refit, and not by their place in that order alone:
  // one that does as well is told before the best, and where it does alone nothing has to be added
  // to the best.
  void refit_plainer(std::span<const ScreenedCause> others, const std::vector<std::string>& names,
                     double base_excess, std::size_t most) {
    if (found_.candidates.empty()) return;
    const auto is_plainer = [this](const ScreenedCause& one) {
      return one.model.size() < found_.candidates.front().fit.hypothesis.size();
    };
    std::vector<ScreenedCause> plainer;
    // As many again, so that the time is at most twice as long.
    std::ranges::copy_if(others, std::back_inserter(plainer), is_plainer);
    if (plainer.size() > most) plainer.resize(most);
    std::vector<FitSummary> fits = fitted_elsewhere(plainer, base_excess);
    for (std::size_t i = 0; i < plainer.size() && !stopped(); ++i) {
      // Asked at each, as a plainer one may lead by now.
      if (!is_plainer(plainer[i])) continue;
      found_.candidates.push_back(
          candidate_of(plainer[i], names,
                       fits.empty() ? refitted(plainer[i], base_excess) : std::move(fits[i])));
      sort_candidates();
    }
  }

  // Causes are added one by one, and the first of them may have been begun where its fit did not
  // arrive: another one then took over what it left. So each is taken out again, with the others
  // fitted on from where they are. What does as well with fewer is told (find_competing()).
  void refit_without_each() {
    if (found_.candidates.empty() || !is_enough(found_.candidates.front())) return;
    const SceneCandidate best = found_.candidates.front();
    const int own = static_cast<int>(best.names.size());
    if (own < 2) return;
    tell("taking out causes that are not needed", 0.86);
    for (int n = 0; n < own && !stopped(); ++n) {
      std::vector<std::string> names = best.names;
      names.erase(names.begin() + n);
      SceneCandidate fewer;
      fewer.names = std::move(names);
      // Those of the causes stand last.
      const int at = static_cast<int>(best.fit.hypothesis.effects.size()) - own + n;
      fewer.fit = fit(best.fit.hypothesis.without(at), how_.last_iterations, options_.trials);
      judge(fewer);
      found_.candidates.push_back(std::move(fewer));
    }
    sort_candidates();
    keep_best_of_each();
  }

  void sort_candidates() {
    std::ranges::stable_sort(found_.candidates, {},
                             [this](const SceneCandidate& one) { return score(one); });
  }

  void judge(SceneCandidate& candidate) {
    candidate.cost = cost_of(candidate.fit);
    candidate.excess = SceneDataSet::beyond_noise(candidate.fit.misfit());
    candidate.check_excess = held_out(candidate.fit.hypothesis);
  }

  // Fewer numbers win where more hardly do better.
  double score(const SceneCandidate& one) const {
    // By a share of what is left and of the noise, and not by nats. Two solvers differ by more than
    // any count of samples makes of one number, and six numbers of a camera's pose imitate one of
    // its focal length.
    return square(one.excess) +
           how_.number_price * one.fit.hypothesis.size() * (1.0 + square(one.excess));
  }

  // Linear costs are too good: whoever keeps more of one, at the whole step or a shorter one, goes
  // first, and from there. Which joint it is, or from where a cause is best begun, they do not say:
  // that of the right one may be worse.
  std::vector<ScreenedCause> tried(const std::vector<ScreenedCause>& all) {
    std::vector<ScreenedCause> screened = in_turns(all);
    const auto most = static_cast<std::size_t>(how_.tried);
    if (screened.size() > most) screened.resize(most);
    std::vector<Hypothesis> models;
    // A contact bends the way: half of a step may leave less than all of it.
    const double shares[] = {1.0, how_.shorter_step};
    for (const ScreenedCause& one : screened)
      for (const double share : shares) {
        Hypothesis model = one.model;
        const Eigen::VectorXd& old = one.begun;
        Eigen::VectorXd u = model.unknowns();
        // The base goes as far along as the cause does, because the step was one of both.
        u.head(old.size()) = old + share * (u.head(old.size()) - old);
        for (long p = old.size(); p < u.size(); ++p)
          // A number on a logarithmic scale has no size that a part could be taken of: it keeps its
          // own.
          if (!model.free[static_cast<std::size_t>(p)].logarithmic) u[p] *= share;
        model.set_unknowns(u);
        models.push_back(model);
      }
    if (models.empty()) return screened;
    const Eigen::MatrixXd residuals =
        evaluator_.residuals(models, evaluator_.options(options_.trials));
    for (std::size_t i = 0; i < screened.size(); ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t s = 0; s < std::size(shares); ++s) {
        const std::size_t at = i * std::size(shares) + s;
        const double cost = 0.5 * residuals.col(static_cast<long>(at)).squaredNorm();
        if (cost >= least) continue;
        least = cost;
        screened[i].model = models[at];
      }
      // Between the linear cost and what came of it.
      // Geometrically, as costs differ by powers of ten.
      screened[i].linear_cost =
          std::sqrt(std::max(screened[i].linear_cost, 1.0) * std::max(least, 1.0));
    }
    // In between, since a start that is out of reach of its linear step may still be led back by a
    // fit.
    std::ranges::stable_sort(screened, {}, &ScreenedCause::linear_cost);
    return screened;
  }

  // The best start of a cause stands for it.
  void keep_best_of_each() {
    std::vector<SceneCandidate> kept;
    for (SceneCandidate& one : found_.candidates)
      if (std::ranges::none_of(
              kept, [&](const SceneCandidate& other) { return other.names == one.names; }))
        kept.push_back(std::move(one));
    found_.candidates = std::move(kept);
  }

  FitSummary fit(const Hypothesis& start, int iterations, const std::vector<int>& trials) {
    return fit_scene(evaluator_, start, evaluator_.options(trials, iterations));
  }

  FitSummary looked_at(const Hypothesis& model) {
    return discrepancy::look_at(evaluator_, model, evaluator_.options(options_.trials));
  }

  std::optional<double> held_out(const Hypothesis& model) {
    // Not zero: nothing held out is no proof.
    if (options_.check.empty()) return std::nullopt;
    return SceneDataSet::beyond_noise(evaluator_.misfit(model, options_.check));
  }

  void conclude() {
    using Outcome = SceneFindings::Outcome;
    // What hides is told for the misfit that a cause must make to be looked for.
    found_.seen_units = allowed();
    const bool best_does = !found_.candidates.empty() && is_enough(found_.candidates.front());
    // A cause has to be needed, too: where the baseline leaves hardly more, any cause does as well.
    if (best_does && pays(found_.candidates.front())) {
      found_.outcome = Outcome::named;
      find_competing();
      if (!found_.competing.empty()) found_.outcome = Outcome::ambiguous;
      found_.material = material_of(found_.candidates.front().fit, experiment_, how_);
      // Against the floor alone, and not against a share of the misfit: the baseline is what all
      // shares are taken of. Held-out trials may object, as something may act in one of them alone.
    } else if (is_adequate(found_.baseline_excess, found_.baseline_check) || is_adequate_finely()) {
      found_.outcome = Outcome::adequate;
      found_.material = material_of(found_.baseline, experiment_, how_);
    } else {
      found_.outcome = Outcome::unknown;
      // Last, since a force at a place of its own, with a course of its own, explains much that is
      // something else.
      if (!stopped()) look_outside();
      found_.material = material_of(found_.baseline, experiment_, how_);
    }
  }

  bool is_adequate(double excess, const std::optional<double>& check) const {
    return excess <= how_.floor && holds_elsewhere(check, found_.nominal_check, how_);
  }

  // A coarse mesh may leave more than the floor where the scene is right: a stalk of 60 mm is three
  // of its segments. So before anything is called unknown, the mesh that judges is asked.
  bool is_adequate_finely() {
    if (!options_.refit_finely || stopped() ||
        found_.baseline_excess > how_.clean_allowance * how_.floor)
      return false;
    tell("refitting the baseline with a finer mesh", 0.88);
    const FinerFit fine = options_.refit_finely(found_.baseline.hypothesis);
    if (!is_adequate(fine.excess, fine.check_excess)) return false;
    found_.baseline = fine.fit;
    found_.baseline_excess = fine.excess;
    found_.baseline_check = fine.check_excess;
    found_.baseline_cost = cost_of(fine.fit);
    return true;
  }

  bool pays(const SceneCandidate& one) const {
    return square(found_.baseline_excess) - square(one.excess) >= how_.least_gain;
  }

  // Among those that do nearly as well as the best, whoever says the fewest things goes first: one
  // thing that explains all is likelier than two or three that happen to look like it. A number of
  // the material that is off is a thing, too.
  void find_competing() {
    const SceneCandidate& best = found_.candidates.front();
    // Things and not numbers: a gain that explains all by itself stood beside a bias together with
    // another modulus and density.
    const auto things = [this](const SceneCandidate& one) {
      return one.names.size() + material_of(one.fit, experiment_, how_).size();
    };
    std::vector<std::size_t> near = {0};
    for (std::size_t i = 1; i < found_.candidates.size(); ++i) {
      const SceneCandidate& one = found_.candidates[i];
      // Two causes always explain what one does. And a cause without which the baseline does hardly
      // worse explains nothing, however plain it is.
      if (one.names.size() > best.names.size() || !is_enough(one) || !pays(one)) continue;
      // A share of what the best leaves, because what is left of both is mostly what solvers differ
      // by.
      if (score(one) - score(best) < how_.tie_share * square(best.excess) + how_.least_tie)
        near.push_back(i);
    }
    std::size_t fewest = things(best);
    for (const std::size_t i : near) fewest = std::min(fewest, things(found_.candidates[i]));
    std::erase_if(near, [&](std::size_t i) { return things(found_.candidates[i]) > fewest; });
    // Of a cause and what it is a special case of both always do, and the plainer one says all.
    const std::vector<std::size_t> plainest = near;
    std::erase_if(near, [&](std::size_t i) {
      return std::ranges::any_of(plainest, [&](std::size_t other) {
        return is_case_of(found_.candidates[other].names, found_.candidates[i].names);
      });
    });
    const std::vector<std::size_t> all = near;
    std::erase_if(near, [&](std::size_t i) {
      return std::ranges::any_of(all, [&](std::size_t other) {
        const FitSummary& one = found_.candidates[other].fit;
        return speaks_for(one, found_.candidates[i].fit,
                          one.hypothesis.size() - found_.baseline.hypothesis.size(), how_);
      });
    });
    // Of three each may speak against the next one: then none does.
    if (near.empty()) near = all;
    // They are in the order of their scores, so this is the best of the plainest.
    const std::size_t first = near.front();
    for (std::size_t i = 1; i < near.size(); ++i) found_.competing.push_back(near[i]);
    std::rotate(found_.candidates.begin(), found_.candidates.begin() + static_cast<long>(first),
                found_.candidates.begin() + static_cast<long>(first) + 1);
  }

  // What is outside acts in some trials, and in some of their time: the baseline is that of the
  // rest. Then: where does a force act that explains what is left?
  void look_outside() {
    tell("looking for something that the scene does not have", 0.9);
    std::vector<int> all = options_.trials;
    // Held-out trials as well: no cause is left that they would have to judge, and the force may be
    // in one of them.
    all.insert(all.end(), options_.check.begin(), options_.check.end());
    refit_what_is_clean(all);
    if (stopped()) return;
    found_.outside =
        find_outside_force(evaluator_, found_.baseline.hypothesis.effects, all, options_.threads);
  }

  // A trial that the material alone explains is one in which nothing else acts.
  void refit_what_is_clean(const std::vector<int>& all) {
    for (const int t : all) {
      if (stopped()) return;
      // Each by itself. Together with a trial in which something else acts no trial would be
      // explained.
      FitSummary own =
          fit(scene_baseline(experiment_, evaluator_.settings()), how_.first_iterations, {t});
      if (SceneDataSet::beyond_noise(own.misfit()) > how_.clean_allowance * how_.floor) continue;
      found_.clean.push_back(t);
    }
    if (found_.clean.empty()) return;
    const FitSummary clean = fit(scene_baseline(experiment_, evaluator_.settings()),
                                 how_.baseline_iterations, found_.clean);
    // Each of them alone was explained by other numbers: then no one plant explains them.
    if (SceneDataSet::beyond_noise(clean.misfit()) > how_.clean_allowance * how_.floor) {
      found_.clean.clear();
      return;
    }
    found_.baseline = clean;
  }

  void tell(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }
  bool stopped() const { return options_.stop && options_.stop(); }

  SceneEvaluator& evaluator_;
  const SceneSearchOptions& options_;
  const SceneSearchSettings& how_;
  const Experiment& experiment_;
  SceneFindings found_;
};

std::string numbers_of(const FitSummary& fit) {
  std::string text;
  for (int p = 0; p < fit.hypothesis.size(); ++p) {
    const effects::FreeParameter& free = fit.hypothesis.free[static_cast<std::size_t>(p)];
    const double value = fit.hypothesis.value(p);
    const double error = fit.standard_error[p] * (free.logarithmic ? value : free.scale);
    text += (text.empty() ? "" : ", ") +
            fit.hypothesis.effects[static_cast<std::size_t>(free.effect)].name + "." + free.name;
    if (free.component > 0 || free.name == "offset" || free.name == "rotation")
      text += std::string("[") + "xyz"[free.component] + "]";
    text += " " + io::format_number(value, 4) + " +- " + io::format_number(error, 2);
    if (free.unit != "1") text += " " + free.unit;
  }
  return text;
}

}  // namespace

SceneFindings search_scene(SceneEvaluator& evaluator, const SceneSearchOptions& options) {
  return Search(evaluator, options).run();
}

std::string joined_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " and ") + name;
  return text;
}

std::string findings_text(const SceneFindings& found, const Experiment&) {
  const auto units = [](double value) { return io::format_number(value, 3); };
  std::string text = "misfit beyond the noise, in noise units: " + units(found.nominal_excess) +
                     " as the files say, " + units(found.baseline_excess) +
                     " with the baseline refitted\n";
  text += "  refitted: " + numbers_of(found.baseline) + "\n";
  for (const SceneCandidate& one : found.candidates)
    text += "  " + joined_names(one.names) + ": " + units(one.excess) + " left" +
            (one.check_excess ? ", held out " + units(*one.check_excess) : "") + "; " +
            numbers_of(one.fit) + "\n";
  if (found.outside.found)
    text += "  a force from outside on " + found.outside.place.curve + " takes " +
            io::format_number(100.0 * found.outside.share, 3) + " % of what is left\n";
  return text;
}

}  // namespace pedicel::discrepancy
