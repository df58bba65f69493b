#pragma once

#include <functional>
#include <string>
#include <vector>

#include "discrepancy/causes.h"
#include "discrepancy/fit.h"

namespace pedicel::discrepancy {

/// A cause (or several) refitted in full together with the baseline's parameters.
struct Candidate {
  std::string cause;  ///< the one that was added last
  FitSummary fit;
  double gain = 0.0;      ///< log-likelihood above the model that it extends
  double evidence = 0.0;  ///< gain less what its parameters and the number of candidates cost
};

/// One for each worker: makes a simulator that runs on the calling thread alone.
using MakeEvaluator = std::function<Evaluator()>;

struct RefitOptions {
  FitOptions fit;
  int threads = 1;
  /// Called now and then, from any thread, with the share that is done.
  std::function<void(double)> progress;
  const std::atomic<bool>* stop = nullptr;
};

/// Refits every cause on top of `base`: a look from all its starts over the first third of the
/// records, a fit of the best two there, then of the better ones over the whole records. Sorted by
/// evidence.
std::vector<Candidate> refit_all(std::vector<Evaluator>& workers, const FitSummary& base,
                                 const std::vector<Cause>& causes, const RefitOptions& options);

/// Bayesian information criterion: what a model's additional parameters cost, with the choice
/// between so many candidates (nats).
double cost_of(int parameters, int samples, std::size_t candidates);

}  // namespace pedicel::discrepancy
