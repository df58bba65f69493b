#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/fit.h"
#include "plugins/discrepancy/test/residual_power.h"

namespace pedicel::discrepancy {

/// How the data would change if a cause were there, small, and the free parameters took their
/// share: what a directed test looks for.
struct Direction {
  std::string cause;
  Hypothesis start;               ///< the cause at the size that `change` stands for
  Eigen::VectorXd change;         ///< whitened, what the parameters cannot take up
  Eigen::VectorXd nuisance_step;  ///< steps of the parameters' unknowns that stand for the rest
  bool has_threshold = false;     ///< does nothing when small: `start` is of full size
  double statistic = 0.0;         ///< standard normal where nothing is wrong
  double systematic = 0.0;        ///< how far our own numerical error could move it
  /// What these steps are against what is known of the parameters beforehand, in noise units, with
  /// its sign turned: the direction's share of the prior's rows (PriorRows).
  Eigen::VectorXd against = {};
};

/// Of both parts, noise units.
double length(const Direction& direction);

/// Directions of every start of every cause, at sizes at which the response is about linear.
/// `known` are those of the same causes about another model, whose sizes are a good first guess.
std::vector<Direction> directions_of(Evaluator& evaluator, const FitSummary& base,
                                     const std::vector<Cause>& causes, const FitOptions& options,
                                     const std::vector<Direction>& known = {});

/// Whether anything is wrong: the largest of the directed statistics against the level that pure
/// noise reaches through the same projections.
struct Alarm {
  double statistic = 0.0;  ///< the largest
  double level = 0.0;      ///< that noise alone hardly exceeds
  int strongest = -1;      ///< direction
  bool raised = false;
  ResidualPower residual_power = {};  ///< what no direction looks for
};

/// Fills in the directions' statistics for a residual and judges them. `numerical` is the whitened
/// error of our own predictions (may be empty).
Alarm judge(std::vector<Direction>& directions, const FitSummary& base,
            const Eigen::VectorXd& numerical, std::uint64_t seed,
            const DiagnosisSettings& settings);

/// The smallest size of a cause that these data would show: where the directed statistic is
/// expected to be `sigma`; of a vector its length. Of a law with a threshold the start's own, where
/// it would be seen. Infinite where nothing would ever be seen.
double detectable_limit(const Direction& direction, double sigma, std::string& parameter);

}  // namespace pedicel::discrepancy
