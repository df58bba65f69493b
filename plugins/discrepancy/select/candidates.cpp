#include "plugins/discrepancy/select/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/core/thread_pool.h"
#include "plugins/discrepancy/fit/profile.h"
#include "plugins/discrepancy/select/candidate_starts.h"
#include "plugins/discrepancy/select/continuation.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/discrepancy/select/place_search.h"
#include "plugins/discrepancy/select/symptom_starts.h"
#include "plugins/discrepancy/test/score_test.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

namespace {

// Iterations of every start, and how many starts go on. Between places there are ridges, on which
// many steps are tried in vain.
struct Look {
  int iterations;
  int leading;
};
constexpr int all_starts = std::numeric_limits<int>::max();

// The better of two fits, by what fits minimise: what is known beforehand counts.
// By cost alone a fit that runs a density far from what plants have would win against one that
// keeps to it.
void keep_better(FitSummary& best, FitSummary&& found) {
  if (best.why == "not run" || objective(found) < objective(best)) best = std::move(found);
}

FitSummary fit_first_part(Evaluator& evaluator, const FitSummary& base, const Cause& cause,
                          FitOptions options, std::size_t count) {
  const Budget& budget = options.settings->budget;
  FitSummary best;
  const std::vector<Hypothesis> starts = best_starts(evaluator, base, cause, options, count);
  // Over the first part only: in a long record a start that is out of phase falls into the next
  // swing.
  options.horizon = budget.candidate_horizon;
  options.iterations = std::min(budget.first_iterations, options.iterations);
  // Steps that gain less than a nat are given up: this is a ranking, and ranks are hundreds of nats
  // apart where the base is far from the data.
  options.least_step = budget.rough_step;
  Eigen::MatrixXd known = base.jacobian;
  for (const Hypothesis& start : starts) {
    FitSummary found = fit(evaluator, start, options, known);
    known = found.jacobian;
    keep_better(best, std::move(found));
  }
  return best;
}

// Ranks by value, largest first: the first `count` of them.
std::vector<int> first_by(const std::vector<double>& value, int count) {
  std::vector<int> order(value.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::ranges::stable_sort(order, [&](int a, int b) { return value[a] > value[b]; });
  // Stable and by index: ties keep the order of the list of causes, whatever threads did.
  order.resize(std::min(static_cast<std::size_t>(count), order.size()));
  return order;
}

// Costs above which a fit is too far behind those that were made before it.
struct Limits {
  const Budget* budget;
  double least = std::numeric_limits<double>::infinity();  // of those
  double base = 0.0;
  // A fit is given up by how far it is behind in what can be gained at all, and never within
  // `lost_by` nats, where a few more iterations may change the order.
  double at(double share) const {
    // Where nobody gains much yet, being behind tells nothing.
    if (base - least < budget->large_gain) return std::numeric_limits<double>::infinity();
    return least + std::max(budget->lost_by, share * (base - least));
  }
};

// In the order of their costs.
std::vector<Hypothesis> by_cost(const std::vector<Hypothesis>& starts, const Scan& scanned) {
  std::vector<double> closeness;
  for (const double cost : scanned.cost) closeness.push_back(-cost);
  // The closest start is fitted first: how far it gets bounds what the others are worth.
  std::vector<Hypothesis> sorted;
  for (const int i : first_by(closeness, static_cast<int>(starts.size())))
    sorted.push_back(starts[i]);
  return sorted;
}

// Whether two starts have come into one valley: places within a hundredth of their curve, sizes
// within a tenth. The better one of them is fitted on.
bool have_met(const Hypothesis& a, Hypothesis b) {
  constexpr double near = 0.1;  // of an unknown
  const Eigen::VectorXd here = a.unknowns();
  if (a.size() != b.size()) return false;
  if ((here - b.unknowns()).cwiseAbs().maxCoeff() >= near) return false;
  // In words, curves and numbers that are not free they must be alike.
  b.set_unknowns(here);
  return std::ranges::equal(a.effects, b.effects, {}, plant::effect_text, plant::effect_text);
}

// The best fit from any of these starts, the closest first: a few iterations from each, the rest
// for those that lead. Where all starts do worse than the base they are out of phase: the closest
// one is also fitted over growing parts of the records.
// `known` are derivatives near by, or those by the base's numbers: a fit begins with steps of the
// right size, in place of finding out.
FitSummary best_fit(Evaluator& evaluator, const FitSummary& base,
                    const std::vector<Hypothesis>& starts, const FitOptions& options,
                    const Look& look, const Limits& limits, Eigen::MatrixXd known) {
  FitOptions few = options, rest = options;
  few.iterations = std::min(look.iterations, options.iterations);
  rest.iterations = options.iterations - few.iterations;
  const Budget& budget = options.settings->budget;
  const double most = limits.at(budget.lost_early);
  // Nor does a start go on that is as far behind the best start of its own cause.
  Limits own = limits;
  own.base = base.cost;
  std::vector<FitSummary> found;
  std::vector<double> closeness;
  // One simulation each before any derivative is taken. A fit from a start takes as many as it has
  // numbers, in each iteration.
  const Scan scanned = scan(evaluator, starts, options);
  for (const Hypothesis& start : by_cost(starts, scanned)) {
    found.push_back(fit(evaluator, start, few, known));
    known = found.back().jacobian;
    closeness.push_back(-objective(found.back()));
    own.least = std::min(own.least, found.back().cost);
    // The closest start is this far off, so those behind it are lost as well.
    if (found.front().cost > limits.at(budget.lost_at_once)) break;
  }
  FitSummary best;
  std::vector<Hypothesis> ahead;
  for (const int i : first_by(closeness, look.leading)) {
    const bool met = std::ranges::any_of(
        ahead, [&](const Hypothesis& other) { return have_met(found[i].hypothesis, other); });
    // Against the best of all causes first, and then against the cause's own best start.
    const bool goes_on = rest.iterations > 0 && !met && found[i].cost <= own.at(budget.lost_early);
    ahead.push_back(found[i].hypothesis);
    keep_better(best, goes_on ? refit(evaluator, found[i], rest) : std::move(found[i]));
  }
  const std::array growing_horizons{0.5 * budget.candidate_horizon, budget.candidate_horizon, 1.0};
  // Dear, so only for a cause that may still win.
  // A start that does worse than no cause at all is out of phase: in a long record its swing slips
  // by whole periods, and each is a valley of its own. Over a short part it is not.
  if (best.cost <= most && scanned.cost[scanned.best] >= base.cost)
    keep_better(best, fit_growing(evaluator, starts[scanned.best], options, growing_horizons));
  return best;
}

// Calls task(evaluator, i) for i below count, each on one worker.
template <class Task>
void share_out(std::vector<Evaluator>& workers, int count, const RefitOptions& options, double from,
               double to, const Task& task) {
  // Workers take the next task when they are free; each result has its own place, so any number of
  // threads gives the same.
  ThreadPool pool(static_cast<int>(workers.size()));
  std::atomic<int> next{0}, done{0};
  pool.for_each(static_cast<int>(workers.size()), [&](int worker) {
    for (int i = next++; i < count; i = next++) {
      // Tasks that were not begun leave their candidates as "not run". Who asks takes these out
      // later.
      if (options.stop && *options.stop) return;
      task(workers[worker], i);
      if (options.progress)
        options.progress(from + (to - from) * static_cast<double>(++done) / count);
    }
  });
}

// All candidates of one model, on their way from starts to a ranking.
class Refits {
 public:
  Refits(const Workers& workers, const FitSummary& base, const std::vector<Cause>& causes,
         const std::vector<Direction>& directions, const RefitOptions& options)
      : coarse_(workers.coarse),
        fine_(workers.fine),
        base_(base),
        causes_(causes),
        directions_(directions),
        options_(options),
        budget_(options.fit.settings->budget),
        // Of every cause the strongest of its directions. Scores are taken once about the base, and
        // are all there is to go by before the first fit.
        score_(score_statistics(causes, directions)),
        samples_(workers.fine.front().data().samples(options.fit.trials)),
        candidates_(causes.size()) {}

  std::vector<Candidate> run() {
    if (candidates_.empty()) return {};
    for (std::size_t i = 0; i < causes_.size(); ++i) candidates_[i].cause = causes_[i].name;
    // A base that misses the data is a bad place to be linear about: then short fits rank, else
    // scores do.
    if (2.0 * base_.cost > options_.fit.settings->evidence.far_from_data * samples_)
      fit_first_parts();
    else
      set_score_gains();
    // Twice, by gain and by score: what either of them believes in gets a whole fit. A short record
    // may hide a slow cause, and a score a strong one.
    choose_whole(score_);
    const std::string foremost_cause = std::ranges::max(candidates_, {}, &Candidate::gain).cause;
    for (Candidate& candidate : candidates_)
      // Look-alikes are told apart by whole fits alone: scores of one family differ by little.
      if (effects::same_family(candidate.cause, foremost_cause) ||
          !continuations(candidate.cause).empty())
        candidate.whole = true;
    std::vector<int> whole;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (candidates_[i].whole) whole.push_back(static_cast<int>(i));
    // A few iterations tell who is behind; only the leaders are worth the rest.
    std::ranges::stable_sort(whole, std::greater(), [&](int i) { return candidates_[i].gain; });
    // The foremost are few and run first, without limits. All others then have a mark to be
    // measured by, and most can be left early.
    const auto others =
        whole.begin() + std::min<std::ptrdiff_t>(budget_.foremost, std::ssize(whole));
    std::vector<int> first(whole.begin(), others), behind(others, whole.end());
    longest_first(behind);
    fit_whole(first, Limits{&budget_}, 0.0, 0.4);
    // The foremost set the mark for the rest.
    Limits limits{&budget_, base_.cost, base_.cost};
    for (const int i : first) limits.least = std::min(limits.least, candidates_[i].fit.cost);
    fit_whole(behind, limits, 0.4, 0.75);
    // After all whole fits, since it starts from one of them, and before the leaders are chosen,
    // since it may make one.
    extend_special_cases();
    const std::vector<int> near = leading(whole, budget_.lost_early);
    refit_coarse(near, budget_.whole_iterations, 0.75);
    std::vector<int> moving = leading(near, budget_.lost_late);
    // What has converged gains nothing by more steps.
    std::erase_if(moving, [&](int i) { return candidates_[i].fit.converged; });
    refit_coarse(moving, options_.fit.iterations, 0.8);
    // Stopped before it was its turn: no candidate, rather than one with a cost of zero.
    // Positions in the list are those of the causes up to here. Only now may candidates leave it.
    std::erase_if(candidates_, [](const Candidate& c) { return c.fit.why == "not run"; });
    std::vector<Candidate*> all;
    for (Candidate& candidate : candidates_)
      if (candidate.whole) all.push_back(&candidate);
    rank(all, coarse_);
    end_with_fine();
    return std::move(candidates_);
  }

 private:
  // Share of the time that the first parts take, where they are fitted, and what is done when a
  // share of the rest is.
  static constexpr double first_parts = 0.4, fine_fits = 0.85;
  double done(double of_rest) const {
    return fitted_first_ ? first_parts + (1.0 - first_parts) * of_rest : of_rest;
  }

  void fit_first_parts() {
    fitted_first_ = true;
    FitOptions early = options_.fit;
    early.horizon = budget_.candidate_horizon;
    // The base over the same part of the records. Its cost over the whole would make every short
    // fit look like a gain.
    const double early_cost =
        0.5 * coarse_.front().residuals(std::span(&base_.hypothesis, 1), early).squaredNorm();
    std::vector<std::size_t> starts(causes_.size(), 1);
    // A second start for those that the linear model believes in.
    // Starts are dear here: all causes are tried, most of them in vain.
    for (const int i : first_by(score_, budget_.whole_candidates)) starts[i] = 2;
    // Those that symptoms speak for come first: a search that is cut short has tried them.
    const std::vector<int> all = symptoms_first(causes_, score_);
    const auto others = all.begin() + std::min<std::ptrdiff_t>(budget_.first_led, std::ssize(all));
    std::vector<int> led(all.begin(), others), rest(others, all.end());
    const auto fit_parts = [&](std::vector<int>& chosen, double from, double to) {
      longest_first(chosen);
      share_causes("first_parts", chosen, from, to, [&](Evaluator& evaluator, int i) {
        candidates_[i].fit = fit_first_part(evaluator, base_, causes_[i], options_.fit, starts[i]);
      });
    };
    const double of_led =
        first_parts * static_cast<double>(led.size()) / std::max<std::size_t>(1, all.size());
    fit_parts(led, 0.0, of_led);
    fit_parts(rest, of_led, first_parts);
    std::vector<double> gain;
    for (Candidate& candidate : candidates_) {
      // Stopped before it was its turn: no gain.
      if (candidate.fit.why != "not run") candidate.gain = early_cost - candidate.fit.cost;
      gain.push_back(candidate.gain);
    }
    choose_whole(gain);
  }

  // So that no worker waits for one long task at the end.
  void longest_first(std::vector<int>& chosen) const {
    const auto work = [&](int i) {
      // About what a fit takes: a simulation for each of its numbers, from each of its starts.
      return causes_[i].starts.size() * (base_.hypothesis.size() + causes_[i].starts[0].size());
    };
    std::ranges::stable_sort(chosen, [&](int a, int b) { return work(a) > work(b); });
  }

  // The first few, and others that are not far behind.
  void choose_whole(const std::vector<double>& worth) {
    const std::vector<int> order = first_by(worth, budget_.whole_candidates);
    for (std::size_t i = 0; i < order.size(); ++i)
      if (std::cmp_less(i, budget_.leaders) ||
          worth[order[i]] > budget_.far_behind * worth[order[0]])
        candidates_[order[i]].whole = true;
  }

  // Of a linear model the gain is half the squared statistic.
  void set_score_gains() {
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      candidates_[i].gain = 0.5 * score_[i] * score_[i];
      candidates_[i].fit.hypothesis = base_.hypothesis;
      candidates_[i].fit.hypothesis.add(causes_[i].starts.front());
      // Not "not run": it has been judged, and stands at the end of the ranking as such.
      candidates_[i].fit.why = "not fitted: its directions score too little";
    }
  }

  void fit_whole(const std::vector<int>& chosen, const Limits& limits, double from, double to) {
    share_causes("whole", chosen, done(from), done(to),
                 [&](Evaluator& evaluator, int i) { fit_whole(evaluator, i, limits); });
  }

  // Calls task(evaluator, i) for the chosen causes, which sets the candidate's fit and nothing
  // else: on the workers, or elsewhere.
  template <class Task>
  void share_causes(const char* stage, const std::vector<int>& chosen, double from, double to,
                    const Task& task) {
    const int count = static_cast<int>(chosen.size());
    if (!options_.parts)
      return share_out(coarse_, count, options_, from, to,
                       [&](Evaluator& evaluator, int c) { task(evaluator, chosen[c]); });
    if (options_.progress) options_.progress(from);
    // Fits that others do come back in the order of the list, as they would have been made here, so
    // that a diagnosis is the same however it was shared out.
    std::vector<FitSummary> fits = fits_by(options_.parts, stage, count, [&](int c) {
      task(coarse_.front(), chosen[c]);
      return candidates_[chosen[c]].fit;
    });
    for (int c = 0; c < count; ++c) candidates_[chosen[c]].fit = std::move(fits[c]);
  }

  FitOptions rough(int iterations) const {
    FitOptions few = options_.fit;
    few.iterations = iterations;
    // A ranking needs no more digits than the gap that it has to tell.
    few.least_step = budget_.rough_step;
    return few;
  }

  void fit_whole(Evaluator& evaluator, int i, const Limits& limits) {
    const bool placed = has_place(causes_[i].starts.front());
    // A place has to be moved along a narrow valley, each step of which is short.
    FitOptions few = rough((placed ? 2 : 1) * budget_.whole_iterations);
    Candidate& candidate = candidates_[i];
    std::vector<Hypothesis> starts;
    // What the first part found is a start like any other.
    if (candidate.fit.jacobian.size() > 0) starts.push_back(candidate.fit.hypothesis);
    std::ranges::move(
        best_linear_starts(evaluator, base_, candidate.cause, directions_, options_.fit),
        std::back_inserter(starts));
    auto plain = best_plain_start(evaluator, base_, causes_[i], options_.fit);
    if (plain) starts.push_back(std::move(*plain));
    // No direction scores and no start does anything: a small one, so that the cause is tried at
    // all.
    if (starts.empty())
      starts.push_back(joined(base_.hypothesis, causes_[i].starts.front().shrunk(0.1), false));
    const std::vector<Direction> back = continuations(candidate.cause);
    const Eigen::MatrixXd known =
        candidate.fit.jacobian.size() > 0 ? std::move(candidate.fit.jacobian) : base_.jacobian;
    candidate.fit = best_fit(evaluator, base_, starts, few,
                             placed ? Look{budget_.place_iterations, all_starts}
                                    : Look{budget_.size_iterations, budget_.size_starts},
                             limits, known);
    // Sliding and twins refine a fit. They are dear, and do not save one that is lost.
    if (candidate.fit.cost > limits.at(budget_.lost_early) && back.empty()) return;
    candidate.fit = slide_along(evaluator, std::move(candidate.fit), few);
    // An anisotropy turned by a right angle says nearly the same; behind a ridge it may be better.
    if (const auto twin = twin_of(candidate.fit.hypothesis))
      keep_better(candidate.fit, fit(evaluator, *twin, few, base_.jacobian));
    for (const Direction& start : back)
      if (auto found = continue_to_prior(evaluator, base_, start, few))
        keep_better(candidate.fit, std::move(*found));
  }

  // What a base that misses the data is pulled by says nothing.
  std::vector<Direction> continuations(const std::string& cause) const {
    if (2.0 * base_.cost > options_.fit.settings->evidence.far_from_data * samples_) return {};
    return likest_continuations(base_, cause, directions_, budget_);
  }

  // A cause that has another one as a special case does at least as well: it goes on from there.
  void extend_special_cases() {
    for (const auto& [special, general] : effects::special_cases()) {
      Candidate* from = whole_one(special);
      Candidate* to = whole_one(general);
      if (!from || !to || stopped() || is_lost(*from, budget_.lost_early)) continue;
      const Cause& cause = causes_[to - candidates_.data()];
      std::vector<Hypothesis> starts =
          continued(base_.hypothesis, from->fit.hypothesis, cause, budget_.gust_start);
      Evaluator& evaluator = coarse_.front();
      starts = screened(evaluator, from->fit, starts);
      if (starts.empty()) continue;
      starts.resize(std::min(static_cast<std::size_t>(budget_.special_starts), starts.size()));
      keep_better(to->fit, best_fit(evaluator, base_, starts, rough(2 * budget_.whole_iterations),
                                    Look{budget_.extended_iterations, budget_.extended_starts},
                                    Limits{&budget_}, base_.jacobian));
    }
  }

  // Those whose change of the special case's prediction would gain more than chance gives, with
  // the size that fits best and the special case's own numbers refitted: to first order, which
  // costs a simulation each in place of a fit. The closest to the data come first.
  std::vector<Hypothesis> screened(Evaluator& evaluator, const FitSummary& special,
                                   const std::vector<Hypothesis>& starts) const {
    const Eigen::MatrixXd residuals = evaluator.residuals(starts, options_.fit);
    std::vector<Hypothesis> found;
    Scan scanned;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      // The special case's own numbers are projected out of the change: what they could do by
      // themselves is no gain of the general case.
      const auto residual = residuals.col(static_cast<Eigen::Index>(i));
      const Eigen::VectorXd change = projected_out(special.jacobian, residual - special.residual);
      const double gain =
          0.5 * std::pow(change.dot(special.residual), 2) / std::max(change.squaredNorm(), 1e-12);
      if (gain <= options_.fit.settings->levels.clear_margin) continue;
      found.push_back(starts[i]);
      scanned.cost.push_back(0.5 * residual.squaredNorm());
    }
    return by_cost(found, scanned);
  }

  Candidate* whole_one(const std::string& cause) {
    // A short fit of a special case is no start: it would carry its errors over to the general one.
    for (Candidate& candidate : candidates_)
      if (candidate.cause == cause && candidate.whole && candidate.fit.why != "not run")
        return &candidate;
    return nullptr;
  }

  // Whether it is too far behind the best one for the rest of its iterations to matter.
  bool is_lost(const Candidate& candidate, double early_or_late) const {
    // A converged fit will get no better, and is held to the narrow limit at once.
    const double share = candidate.fit.converged ? budget_.lost_share : early_or_late;
    return candidate.fit.why == "not run" ||
           candidate.fit.cost >
               Limits{&budget_, least_cost(candidates_, base_), base_.cost}.at(share);
  }

  // The closest ones of those that may still lead.
  std::vector<int> leading(const std::vector<int>& of, double early_or_late) const {
    std::vector<int> found;
    for (const int i : of)
      if (!is_lost(candidates_[i], early_or_late)) found.push_back(i);
    std::ranges::stable_sort(found, {}, [&](int i) { return candidates_[i].fit.cost; });
    found.resize(std::min(static_cast<std::size_t>(budget_.leaders), found.size()));
    return found;
  }

  void refit_coarse(const std::vector<int>& chosen, int iterations, double from) {
    FitOptions rest = options_.fit;
    rest.iterations = std::min(rest.iterations, iterations);
    share_out(coarse_, static_cast<int>(chosen.size()), options_, done(from), done(from + 0.05),
              [&](Evaluator& evaluator, int c) {
                FitSummary& found = candidates_[chosen[c]].fit;
                found = refit(evaluator, found, rest);
              });
  }

  bool is_near_the_best(const Candidate& candidate) const {
    return candidates_.front().evidence - candidate.evidence <= budget_.near_by;
  }

  // Whether it may be near once the fine simulator has its say.
  bool could_be_near(const Candidate& candidate) const {
    const Candidate& best = candidates_.front();
    // The coarse simulator is off by a share of what a cause explains, so nearness is also asked
    // for as a share of the best gain.
    return is_near_the_best(candidate) ||
           best.evidence - candidate.evidence <= budget_.near_share * best.gain;
  }

  // The first few stand in their final order once all of them were refitted: those that are not
  // near with a few iterations, which tell whether they will be.
  void end_with_fine() {
    std::set<std::string> begun;
    double from = fine_fits;
    while (!stopped()) {
      std::vector<Candidate*> open;
      for (int i = 0; i < std::min<int>(budget_.leaders, std::ssize(candidates_)); ++i) {
        Candidate& candidate = candidates_[i];
        const bool near = begun.contains(candidate.cause) ? is_near_the_best(candidate)
                                                          : could_be_near(candidate);
        if (candidate.whole && !candidate.fine && near) open.push_back(&candidate);
      }
      // Fine fits change the order, and the order says who needs one: until both agree.
      if (open.empty()) return;
      // How often the order changes is not known: each round takes half of what is left.
      const double to = 0.5 * (1.0 + from);
      share_out(fine_, static_cast<int>(open.size()), options_, done(from), done(to),
                [&](Evaluator& evaluator, int i) {
                  // Asked before the fit: afterwards the order may be another one, and then the
                  // loop comes round again.
                  const bool to_the_end = is_near_the_best(*open[i]);
                  FitOptions options = options_.fit;
                  // A few iterations tell whether it comes near; most do not.
                  if (!to_the_end)
                    options.iterations = std::min(budget_.fine_iterations, options.iterations);
                  if (!begun.contains(open[i]->cause)) start_with_fine(evaluator, *open[i]);
                  open[i]->fit = refit(evaluator, open[i]->fit, options);
                  open[i]->fine = to_the_end || open[i]->fit.converged;
                });
      from = to;
      for (const Candidate* candidate : open) begun.insert(candidate->cause);
      rank(open, fine_);
    }
  }

  void start_with_fine(Evaluator& evaluator, Candidate& candidate) const {
    const auto cause = std::ranges::find(causes_, candidate.cause, &Cause::name);
    // A threshold just beyond the sharpest bend does nothing, and that bend is another one on a
    // finer mesh. So it is looked for again before the fit goes on.
    candidate.fit.hypothesis =
        with_threshold_by(evaluator, candidate.fit.hypothesis, *cause, options_.fit);
  }

  bool stopped() const { return options_.stop && *options_.stop; }

  // Gains, evidence and order of all, after the fits of some have `changed`.
  void rank(const std::vector<Candidate*>& changed, std::vector<Evaluator>& workers) {
    if (stopped()) return;
    // One scale for all, from the best fit: else a bad model would be judged by the noise that it
    // makes.
    const double dispersion = dispersion_of(candidates_, base_, samples_);
    judge_held_out(changed, workers, dispersion);
    weigh(candidates_, base_, samples_, dispersion, *options_.fit.settings);
  }

  // The parameters were not fitted to these trials, so that nothing is to be paid for them there.
  void judge_held_out(const std::vector<Candidate*>& changed, std::vector<Evaluator>& workers,
                      double dispersion) {
    if (options_.check_trials.empty()) return;
    FitOptions check = options_.fit;
    check.trials = options_.check_trials;
    if (kept_.empty()) {
      // With the fine simulator for all: the base is compared with fits of both kinds, and is made
      // once.
      base_held_out_ = held_out_model(fine_.front(), base_, check);
      // All keys before the threads begin: a map may not grow under them.
      for (const Candidate* candidate : changed) kept_[candidate->cause] = {};
    }
    // Says nothing of its progress: it is a small part, and comes again after every change.
    RefitOptions quietly = options_;
    quietly.progress = {};
    share_out(workers, static_cast<int>(changed.size()), quietly, 0.0, 0.0,
              [&](Evaluator& evaluator, int i) {
                kept_.at(changed[i]->cause) = held_out_model(evaluator, changed[i]->fit, check);
              });
    if (stopped()) return;
    std::vector<Candidate*> whole;
    std::vector<HeldOutModel> models;
    for (Candidate& candidate : candidates_) {
      if (!candidate.whole) continue;
      whole.push_back(&candidate);
      models.push_back(kept_.at(candidate.cause));
    }
    const int samples = fine_.front().data().samples(check.trials);
    const std::vector<HeldOut> found = held_out(base_held_out_, models, samples, dispersion);
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i]->held_out = found[i];
  }

  std::vector<Evaluator>&coarse_, &fine_;
  const FitSummary& base_;
  const std::vector<Cause>& causes_;
  const std::vector<Direction>& directions_;
  const RefitOptions& options_;
  const Budget& budget_;
  const std::vector<double> score_;
  const int samples_;
  std::vector<Candidate> candidates_;
  bool fitted_first_ = false;
  HeldOutModel
      base_held_out_;  // on the held-out trials, as those of the causes that were fitted whole
  std::map<std::string, HeldOutModel> kept_;
};

}  // namespace

std::vector<Candidate> refit_all(const Workers& workers, const FitSummary& base,
                                 const std::vector<Cause>& causes,
                                 const std::vector<Direction>& directions,
                                 const RefitOptions& options) {
  return Refits(workers, base, causes, directions, options).run();
}

}  // namespace pedicel::discrepancy
