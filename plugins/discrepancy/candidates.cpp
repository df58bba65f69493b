#include "discrepancy/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/thread_pool.h"

namespace pedicel::discrepancy {

namespace {

constexpr double first_horizon = 0.35;
constexpr int first_iterations = 6, whole_iterations = 5;
constexpr std::size_t leaders = 4;
constexpr std::size_t most_whole = 8;  // of each of the two lists

Hypothesis joined(const Hypothesis& base, const Hypothesis& start, bool from_nominal) {
  Hypothesis both = base;
  // A baseline that was pulled away by what it lacks may be a bad place to start from.
  if (from_nominal)
    for (int i = 0; i < both.size(); ++i)
      if (both.free[i].name == "factor" && both.free[i].prior_centre == 1.0) both.set_value(i, 1.0);
  both.add(start);
  both.name = start.name;
  return both;
}

// The best `keep` starts, by a look at the first part of the records.
std::vector<Hypothesis> best_starts(Evaluator& evaluator, const FitSummary& base,
                                    const Cause& cause, FitOptions options, std::size_t keep) {
  std::vector<Hypothesis> starts;
  for (const Hypothesis& start : cause.starts)
    for (const double share : {1.0, 0.2})
      starts.push_back(joined(base.hypothesis, start.shrunk(share), false));
  for (const Hypothesis& start : cause.starts)
    starts.push_back(joined(base.hypothesis, start, true));
  options.horizon = first_horizon;
  const Scan found = scan(evaluator, starts, options);
  std::vector<std::size_t> order(starts.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return found.cost[a] < found.cost[b]; });
  std::vector<Hypothesis> best;
  for (std::size_t i = 0; i < std::min(keep, order.size()); ++i) best.push_back(starts[order[i]]);
  return best;
}

FitSummary fit_first_part(Evaluator& evaluator, const FitSummary& base, const Cause& cause,
                          FitOptions options, std::size_t count) {
  FitSummary best;
  const std::vector<Hypothesis> starts = best_starts(evaluator, base, cause, options, count);
  options.horizon = first_horizon;
  options.iterations = std::min(first_iterations, options.iterations);
  for (const Hypothesis& start : starts) {
    FitSummary found = fit(evaluator, start, options);
    if (best.why == "not run" || found.cost < best.cost) best = std::move(found);
  }
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

// Ranks by value, largest first: the first `count` of them.
std::vector<int> first_by(const std::vector<double>& value, std::size_t count) {
  std::vector<int> order(value.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::ranges::stable_sort(order, [&](int a, int b) { return value[a] > value[b]; });
  order.resize(std::min(count, order.size()));
  return order;
}

// Gains and evidence of the whole fits, and the order.
void weigh(std::vector<Candidate>& candidates, const FitSummary& base, int samples) {
  // Where even the best model leaves more than noise, differences count for less.
  double least = base.cost;
  for (const Candidate& candidate : candidates)
    if (candidate.whole && candidate.fit.why != "not run")
      least = std::min(least, candidate.fit.cost);
  const double dispersion = std::max(1.0, 2.0 * least / samples);
  for (Candidate& candidate : candidates) {
    if (candidate.whole) candidate.gain = (base.cost - candidate.fit.cost) / dispersion;
    const int added = candidate.fit.hypothesis.size() - base.hypothesis.size();
    candidate.evidence = candidate.gain - cost_of(added, samples, candidates.size());
  }
  std::erase_if(candidates, [](const Candidate& c) { return c.fit.why == "not run"; });
  std::ranges::stable_sort(candidates, [](const Candidate& a, const Candidate& b) {
    return a.whole != b.whole ? a.whole : a.evidence > b.evidence;
  });
}

}  // namespace

double cost_of(int parameters, int samples, std::size_t candidates) {
  return 0.5 * parameters * std::log(std::max(samples, 2)) +
         std::log(static_cast<double>(std::max<std::size_t>(candidates, 1)));
}

std::vector<Candidate> refit_all(std::vector<Evaluator>& workers, const FitSummary& base,
                                 const std::vector<Cause>& causes,
                                 const std::vector<double>& promise, const RefitOptions& options) {
  const int count = static_cast<int>(causes.size());
  std::vector<Candidate> candidates(causes.size());
  FitOptions early = options.fit;
  early.horizon = first_horizon;
  const double early_cost =
      0.5 * workers.front().residuals(std::span(&base.hypothesis, 1), early).squaredNorm();
  std::vector<std::size_t> starts(causes.size(), 1);
  for (const int i : first_by(promise, most_whole)) starts[i] = 2;
  share_out(workers, count, options, 0.0, 0.6, [&](Evaluator& evaluator, int i) {
    candidates[i].cause = causes[i].name;
    candidates[i].fit = fit_first_part(evaluator, base, causes[i], options.fit, starts[i]);
    candidates[i].gain = early_cost - candidates[i].fit.cost;
  });
  std::vector<double> early_gain;
  for (const Candidate& candidate : candidates) early_gain.push_back(candidate.gain);
  for (const int i : first_by(early_gain, most_whole)) candidates[i].whole = true;
  for (const int i : first_by(promise, most_whole)) candidates[i].whole = true;
  std::vector<int> whole;
  for (int i = 0; i < count; ++i)
    if (candidates[i].whole) whole.push_back(i);
  // A few iterations tell who is behind; only the leaders are worth the rest.
  const auto go_on = [&](const std::vector<int>& chosen, int iterations, double from, double to) {
    FitOptions full = options.fit;
    full.iterations = iterations;
    share_out(workers, static_cast<int>(chosen.size()), options, from, to,
              [&](Evaluator& evaluator, int c) {
                Candidate& candidate = candidates[chosen[c]];
                candidate.fit = fit(evaluator, candidate.fit.hypothesis, full);
              });
  };
  go_on(whole, whole_iterations, 0.6, 0.85);
  std::vector<double> closeness(causes.size(), -std::numeric_limits<double>::infinity());
  for (const int i : whole) closeness[i] = -candidates[i].fit.cost;
  go_on(first_by(closeness, std::min(leaders, whole.size())), options.fit.iterations, 0.85, 1.0);
  weigh(candidates, base, workers.front().data().samples(options.fit.trials));
  return candidates;
}

}  // namespace pedicel::discrepancy
