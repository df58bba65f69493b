#pragma once

#include <atomic>
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
  /// False: it fell so far behind over the first part of the records, and its direction shows so
  /// little, that it was not refitted over the whole; its gain is that of the first part.
  bool whole = false;
};

struct RefitOptions {
  FitOptions fit;
  /// Called now and then, from any thread, with the share that is done.
  std::function<void(double)> progress;
  const std::atomic<bool>* stop = nullptr;
};

/// Refits every cause on top of `base`: a look from all its starts over the first third of the
/// records and a fit of the best one or two there; then those that did best, and those whose
/// directed statistic (`promise`, one a cause) is largest, over the whole records. Sorted by
/// evidence, those of the first part last.
std::vector<Candidate> refit_all(std::vector<Evaluator>& workers, const FitSummary& base,
                                 const std::vector<Cause>& causes,
                                 const std::vector<double>& promise, const RefitOptions& options);

/// Bayesian information criterion: what a model's additional parameters cost, with the choice
/// between so many candidates (nats).
double cost_of(int parameters, int samples, std::size_t candidates);

}  // namespace pedicel::discrepancy
