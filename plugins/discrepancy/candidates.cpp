#include "discrepancy/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "core/thread_pool.h"
#include "discrepancy/candidate_starts.h"
#include "discrepancy/cause_names.h"
#include "discrepancy/evidence.h"
#include "discrepancy/place_search.h"
#include "discrepancy/profile.h"
#include "discrepancy/promise.h"
#include "discrepancy/way_back.h"

namespace pedicel::discrepancy {

namespace {

constexpr int first_iterations = 6, whole_iterations = 10;
constexpr double rough_step = 1.0;  // nats, of fits that only tell who leads
constexpr std::size_t leaders = 6;
constexpr std::size_t most_whole = 8;  // of each of the two lists
constexpr std::array growing_horizons{0.5 * first_horizon, first_horizon, 1.0};
constexpr int look_iterations = 2;                   // of every start, and
constexpr std::size_t leading_starts = 2;            // go on
constexpr double far_behind = 0.3;                   // of the first one's gain or statistic
constexpr double near_by = 50.0, near_share = 0.05;  // nats, of the best one's gain
constexpr double lost_by = 200.0, lost_share = 0.3;  // nats, likewise: before its last iterations,
constexpr double still_moving = 2.0;                 // times that where it had no time to converge
constexpr double small_residual = 2.0;               // mean square in noise units, see refit_all()

// The better of two fits, by what fits minimise: what is known beforehand counts.
void keep_better(FitSummary& best, FitSummary&& found) {
  if (best.why == "not run" || objective(found) < objective(best)) best = std::move(found);
}

FitSummary fit_first_part(Evaluator& evaluator, const FitSummary& base, const Cause& cause,
                          FitOptions options, std::size_t count) {
  FitSummary best;
  const std::vector<Hypothesis> starts = best_starts(evaluator, base, cause, options, count);
  options.horizon = first_horizon;
  options.iterations = std::min(first_iterations, options.iterations);
  options.least_step = rough_step;
  for (const Hypothesis& start : starts)
    keep_better(best, fit(evaluator, start, options, base.jacobian));
  return best;
}

// Ranks by value, largest first: the first `count` of them.
std::vector<int> first_by(const std::vector<double>& value, std::size_t count) {
  std::vector<int> order(value.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::ranges::stable_sort(order, [&](int a, int b) { return value[a] > value[b]; });
  order.resize(std::min(count, order.size()));
  return order;
}

// The best fit from any of these starts: a few iterations from each, the rest for those that lead.
// Where all starts do worse than the base they are out of phase: the closest one is also fitted
// over growing parts of the records.
FitSummary best_fit(Evaluator& evaluator, const FitSummary& base,
                    const std::vector<Hypothesis>& starts, const FitOptions& options) {
  FitOptions look = options, rest = options;
  // Between places there are ridges, on which many steps are tried in vain.
  if (!has_place(starts.front())) look.iterations = std::min(look_iterations, options.iterations);
  rest.iterations = options.iterations - look.iterations;
  std::vector<FitSummary> found;
  std::vector<double> closeness;
  for (const Hypothesis& start : starts) {
    found.push_back(fit(evaluator, start, look, base.jacobian));
    closeness.push_back(-objective(found.back()));
  }
  FitSummary best;
  for (const int i : first_by(closeness, leading_starts))
    keep_better(best, rest.iterations > 0 ? refit(evaluator, found[i], rest) : std::move(found[i]));
  const Scan scanned = scan(evaluator, starts, options);
  if (scanned.cost[scanned.best] >= base.cost)
    keep_better(best, fit_growing(evaluator, starts[scanned.best], options, growing_horizons));
  return best;
}

// Calls task(evaluator, i) for i below count, each on one worker.
template <class Task>
void share_out(std::vector<Evaluator>& workers, int count, const RefitOptions& options, double from,
               double to, const Task& task) {
  ThreadPool pool(static_cast<int>(workers.size()));
  std::atomic<int> next{0}, done{0};
  pool.for_each(static_cast<int>(workers.size()), [&](int worker) {
    for (int i = next++; i < count; i = next++) {
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
        promise_(promise_of(causes, directions)),
        samples_(workers.fine.front().data().samples(options.fit.trials)),
        candidates_(causes.size()) {}

  std::vector<Candidate> run() {
    for (std::size_t i = 0; i < causes_.size(); ++i) candidates_[i].cause = causes_[i].name;
    if (2.0 * base_.cost > small_residual * samples_)
      fit_first_parts();
    else
      promise_gains();
    choose_whole(promise_);
    for (std::size_t i = 0; i < causes_.size(); ++i)
      if (!ways_back(causes_[i].name).empty()) candidates_[i].whole = true;
    std::vector<int> whole;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (candidates_[i].whole) whole.push_back(static_cast<int>(i));
    // A few iterations tell who is behind; only the leaders are worth the rest.
    longest_first(whole);
    share_out(coarse_, static_cast<int>(whole.size()), options_, 0.5, 0.7,
              [&](Evaluator& evaluator, int c) { fit_whole(evaluator, whole[c]); });
    extend_special_cases();
    const std::vector<int> first = leading(whole);
    share_out(coarse_, static_cast<int>(first.size()), options_, 0.7, 0.8,
              [&](Evaluator& evaluator, int c) {
                FitSummary& found = candidates_[first[c]].fit;
                found = refit(evaluator, found, options_.fit);
              });
    std::erase_if(candidates_, [](const Candidate& c) { return c.fit.why == "not run"; });
    std::vector<Candidate*> all;
    for (Candidate& candidate : candidates_)
      if (candidate.whole) all.push_back(&candidate);
    rank(all, coarse_);
    end_with_fine();
    return std::move(candidates_);
  }

 private:
  void fit_first_parts() {
    FitOptions early = options_.fit;
    early.horizon = first_horizon;
    const double early_cost =
        0.5 * coarse_.front().residuals(std::span(&base_.hypothesis, 1), early).squaredNorm();
    std::vector<std::size_t> starts(causes_.size(), 1);
    for (const int i : first_by(promise_, most_whole)) starts[i] = 2;
    std::vector<int> all(causes_.size());
    std::iota(all.begin(), all.end(), 0);
    longest_first(all);
    share_out(coarse_, static_cast<int>(all.size()), options_, 0.0, 0.5,
              [&](Evaluator& evaluator, int c) {
                const int i = all[c];
                candidates_[i].fit =
                    fit_first_part(evaluator, base_, causes_[i], options_.fit, starts[i]);
                candidates_[i].gain = early_cost - candidates_[i].fit.cost;
              });
    std::vector<double> gain;
    for (const Candidate& candidate : candidates_) gain.push_back(candidate.gain);
    choose_whole(gain);
  }

  // So that no worker waits for one long task at the end.
  void longest_first(std::vector<int>& chosen) const {
    const auto work = [&](int i) {
      return causes_[i].starts.size() * (base_.hypothesis.size() + causes_[i].starts[0].size());
    };
    std::ranges::stable_sort(chosen, [&](int a, int b) { return work(a) > work(b); });
  }

  // The first few, and others that are not far behind.
  void choose_whole(const std::vector<double>& worth) {
    const std::vector<int> order = first_by(worth, most_whole);
    for (std::size_t i = 0; i < order.size(); ++i)
      if (i < leaders || worth[order[i]] > far_behind * worth[order[0]])
        candidates_[order[i]].whole = true;
  }

  // Of a linear model the gain is half the squared statistic.
  void promise_gains() {
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      candidates_[i].gain = 0.5 * promise_[i] * promise_[i];
      candidates_[i].fit.hypothesis = base_.hypothesis;
      candidates_[i].fit.hypothesis.add(causes_[i].starts.front());
      candidates_[i].fit.why = "not fitted: its directions promise too little";
    }
  }

  void fit_whole(Evaluator& evaluator, int i) {
    FitOptions few = options_.fit;
    few.iterations = has_place(causes_[i].starts.front()) ? 2 * whole_iterations : whole_iterations;
    few.least_step = rough_step;
    Candidate& candidate = candidates_[i];
    std::vector<Hypothesis> starts;
    if (candidate.fit.jacobian.size() > 0) starts.push_back(candidate.fit.hypothesis);
    std::ranges::move(
        best_linear_starts(evaluator, base_, candidate.cause, directions_, options_.fit),
        std::back_inserter(starts));
    auto plain = best_plain_start(evaluator, base_, causes_[i], options_.fit);
    if (plain) starts.push_back(std::move(*plain));
    if (starts.empty())
      starts.push_back(joined(base_.hypothesis, causes_[i].starts.front().shrunk(0.1), false));
    candidate.fit = slide_along(evaluator, best_fit(evaluator, base_, starts, few), few);
    if (const auto twin = twin_of(candidate.fit.hypothesis))
      keep_better(candidate.fit, fit(evaluator, *twin, few, base_.jacobian));
    for (const Direction& start : ways_back(candidate.cause))
      if (auto found = walk_back(evaluator, base_, start, few))
        keep_better(candidate.fit, std::move(*found));
  }

  // What a base that misses the data is pulled by says nothing.
  std::vector<Direction> ways_back(const std::string& cause) const {
    if (2.0 * base_.cost > small_residual * samples_) return {};
    return likest_way_back(base_, cause, directions_);
  }

  // A cause that has another one as a special case does at least as well: it goes on from there.
  void extend_special_cases() {
    for (const auto& [special, general] : special_cases()) {
      Candidate* from = whole_one(special);
      Candidate* to = whole_one(general);
      if (!from || !to || stopped() || is_lost(*from, least_cost(candidates_, base_))) continue;
      const Cause& cause = causes_[to - candidates_.data()];
      const std::vector<Hypothesis> starts =
          continued(base_.hypothesis, from->fit.hypothesis, cause);
      Evaluator& evaluator = coarse_.front();
      const Scan found = scan(evaluator, starts, options_.fit);
      FitOptions few = options_.fit;
      few.iterations = 2 * whole_iterations;
      few.least_step = rough_step;
      keep_better(to->fit, fit(evaluator, starts[found.best], few, base_.jacobian));
    }
  }

  Candidate* whole_one(const std::string& cause) {
    for (Candidate& candidate : candidates_)
      if (candidate.cause == cause && candidate.whole && candidate.fit.why != "not run")
        return &candidate;
    return nullptr;
  }

  // Whether it is too far from the best one for the rest of its iterations to matter.
  bool is_lost(const Candidate& candidate, double least) const {
    const double allowed = (candidate.fit.converged ? 1.0 : still_moving) *
                           std::max(lost_by, lost_share * (base_.cost - least));
    return candidate.fit.why == "not run" || candidate.fit.cost - least > allowed;
  }

  // Of those that were fitted whole, the closest ones.
  std::vector<int> leading(const std::vector<int>& whole) const {
    std::vector<double> closeness(candidates_.size(), -std::numeric_limits<double>::infinity());
    const double least = least_cost(candidates_, base_);
    std::size_t count = 0;
    for (const int i : whole) {
      if (is_lost(candidates_[i], least)) continue;
      closeness[i] = -candidates_[i].fit.cost;
      ++count;
    }
    return first_by(closeness, std::min(leaders, count));
  }

  // Whether it may be the best or a rival of it, the coarse simulator's errors considered.
  bool is_near_the_best(const Candidate& candidate) const {
    const Candidate& best = candidates_.front();
    return best.evidence - candidate.evidence <= std::max(near_by, near_share * best.gain);
  }

  // The first few stand in their final order once all of them were refitted.
  void end_with_fine() {
    while (!stopped()) {
      std::vector<Candidate*> open;
      for (std::size_t i = 0; i < std::min(leaders, candidates_.size()); ++i)
        if (candidates_[i].whole && !candidates_[i].fine && is_near_the_best(candidates_[i]))
          open.push_back(&candidates_[i]);
      if (open.empty()) return;
      share_out(fine_, static_cast<int>(open.size()), options_, 0.8, 1.0,
                [&](Evaluator& evaluator, int i) {
                  open[i]->fit = refit(evaluator, open[i]->fit, options_.fit);
                  open[i]->fine = true;
                });
      rank(open, fine_);
    }
  }

  bool stopped() const { return options_.stop && *options_.stop; }

  // Gains, evidence and order of all, after the fits of some have `changed`.
  void rank(const std::vector<Candidate*>& changed, std::vector<Evaluator>& workers) {
    if (stopped()) return;
    const double dispersion = dispersion_of(candidates_, base_, samples_);
    ask_kept_back(changed, workers, dispersion);
    weigh(candidates_, base_, samples_, dispersion);
  }

  // The parameters were not fitted to these trials, so that nothing is to be paid for them there.
  void ask_kept_back(const std::vector<Candidate*>& changed, std::vector<Evaluator>& workers,
                     double dispersion) {
    if (options_.check_trials.empty()) return;
    FitOptions check = options_.fit;
    check.trials = options_.check_trials;
    if (kept_.empty()) {
      base_kept_ = kept_back(fine_.front(), base_, check);
      for (const Candidate* candidate : changed) kept_[candidate->cause] = {};
    }
    share_out(workers, static_cast<int>(changed.size()), options_, 1.0, 1.0,
              [&](Evaluator& evaluator, int i) {
                kept_.at(changed[i]->cause) = kept_back(evaluator, changed[i]->fit, check);
              });
    if (stopped()) return;
    std::vector<Candidate*> whole;
    std::vector<KeptBack> models;
    for (Candidate& candidate : candidates_) {
      if (!candidate.whole) continue;
      whole.push_back(&candidate);
      models.push_back(kept_.at(candidate.cause));
    }
    const int samples = fine_.front().data().samples(check.trials);
    const std::vector<HeldOut> found = held_out(base_kept_, models, samples, dispersion);
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i]->held_out = found[i];
  }

  std::vector<Evaluator>&coarse_, &fine_;
  const FitSummary& base_;
  const std::vector<Cause>& causes_;
  const std::vector<Direction>& directions_;
  const RefitOptions& options_;
  const std::vector<double> promise_;
  const int samples_;
  std::vector<Candidate> candidates_;
  KeptBack base_kept_;  // on the trials kept back, as those of the causes that were fitted whole
  std::map<std::string, KeptBack> kept_;
};

}  // namespace

std::vector<Candidate> refit_all(const Workers& workers, const FitSummary& base,
                                 const std::vector<Cause>& causes,
                                 const std::vector<Direction>& directions,
                                 const RefitOptions& options) {
  return Refits(workers, base, causes, directions, options).run();
}

}  // namespace pedicel::discrepancy
