#include "discrepancy/candidates.h"

#include <algorithm>
#include <cmath>

#include "core/thread_pool.h"

namespace pedicel::discrepancy {

namespace {

constexpr double first_horizon = 0.35;
constexpr int lanes = 8;  // hypotheses that cost about as much as one

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

FitSummary refit(Evaluator& evaluator, const FitSummary& base, const Cause& cause,
                 const FitOptions& options) {
  FitSummary best;
  for (const Hypothesis& start : best_starts(evaluator, base, cause, options, 2)) {
    FitOptions early = options;
    early.horizon = first_horizon;
    early.iterations = std::min(8, options.iterations);
    FitSummary found = fit(evaluator, start, early);
    found = fit(evaluator, found.hypothesis, options);
    if (best.why == "not run" || found.cost < best.cost) best = std::move(found);
  }
  return best;
}

}  // namespace

double cost_of(int parameters, int samples, std::size_t candidates) {
  return 0.5 * parameters * std::log(std::max(samples, 2)) +
         std::log(static_cast<double>(std::max<std::size_t>(candidates, 1)));
}

std::vector<Candidate> refit_all(std::vector<Evaluator>& workers, const FitSummary& base,
                                 const std::vector<Cause>& causes, const RefitOptions& options) {
  std::vector<Candidate> candidates(causes.size());
  ThreadPool pool(static_cast<int>(workers.size()));
  std::atomic<int> next{0}, done{0};
  const int count = static_cast<int>(causes.size());
  pool.for_each(static_cast<int>(workers.size()), [&](int worker) {
    for (int i = next++; i < count; i = next++) {
      if (options.stop && *options.stop) return;
      Candidate& candidate = candidates[i];
      candidate.cause = causes[i].name;
      candidate.fit = refit(workers[worker], base, causes[i], options.fit);
      if (options.progress) options.progress(static_cast<double>(++done) / count);
    }
  });
  const int samples = workers.front().data().samples(options.fit.trials);
  // Where even the best model leaves more than noise, differences count for less.
  double least = base.cost;
  for (const Candidate& candidate : candidates)
    if (candidate.fit.why != "not run") least = std::min(least, candidate.fit.cost);
  const double dispersion = std::max(1.0, 2.0 * least / samples);
  for (Candidate& candidate : candidates) {
    candidate.gain = (base.cost - candidate.fit.cost) / dispersion;
    const int added = candidate.fit.hypothesis.size() - base.hypothesis.size();
    candidate.evidence = candidate.gain - cost_of(added, samples, causes.size());
  }
  std::erase_if(candidates, [](const Candidate& c) { return c.fit.why == "not run"; });
  std::ranges::stable_sort(
      candidates, [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
  return candidates;
}

}  // namespace pedicel::discrepancy
