#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/fit.h"
#include "plugins/discrepancy/fit/fit_parts.h"
#include "plugins/discrepancy/test/held_out.h"
#include "plugins/discrepancy/test/statistics.h"

namespace pedicel::discrepancy {

/// A cause (or several) refitted in full together with the baseline's parameters.
struct Candidate {
  std::string cause;  ///< the one that was added last
  FitSummary fit;
  double gain = 0.0;  ///< log-likelihood above the model that it extends
  /// Gain less what its parameters and the number of candidates cost, and of a whole fit what it
  /// gains on the held-out trials.
  double evidence = 0.0;
  HeldOut held_out;  ///< on the held-out trials, of a whole fit
  /// The cause that it turned into, because its fit ended where that one begins (limits()); empty
  /// otherwise.
  std::string limit_of;
  /// False: it fell so far behind over the first part of the records, and its direction shows so
  /// little, that it was not refitted over the whole; its gain is that of the first part, or what
  /// its direction predicts.
  bool whole = false;
  bool fine = false;  ///< whether the fit was ended with the fine simulator
};

struct RefitOptions {
  FitOptions fit;
  std::vector<int> check_trials;  ///< held out from the fits; may be empty
  /// Called now and then, from any thread, with the share that is done.
  std::function<void(double)> progress;
  const std::atomic<bool>* stop = nullptr;
  FitParts* parts = nullptr;  ///< does the first fits of the causes; null: they are done here
};

/// One evaluator for each thread, of either kind; the coarse ones agree with the others at the base
/// (coarse_model.h).
struct Workers {
  std::vector<Evaluator>& coarse;
  std::vector<Evaluator>& fine;
};

/// Refits every cause on top of `base`. Where the base leaves little more than noise, the linear
/// model about it says from where: the sizes that the data give to the cause's strongest
/// directions, the base's parameters moved along. Where it leaves much, all starts are looked at
/// over the first third of the records and the best one or two fitted there, too. Over the whole
/// records go the causes that did best there and those whose directions are strongest. All that
/// with the coarse simulators; the first few are refitted with the fine ones. Sorted by evidence,
/// those that were not fitted over the whole last.
std::vector<Candidate> refit_all(const Workers& workers, const FitSummary& base,
                                 const std::vector<Cause>& causes,
                                 const std::vector<Direction>& directions,
                                 const RefitOptions& options);

}  // namespace pedicel::discrepancy
