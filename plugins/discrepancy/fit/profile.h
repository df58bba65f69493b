#pragma once

#include <functional>
#include <optional>

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// Where one side of an interval ends.
struct ProfileEnd {
  double unknown = 0.0;  ///< value of the free parameter's unknown
  /// The data do not object: up to the parameter's bound, or to where another one meets its own.
  bool at_bound = false;
  int refits = 0;  ///< spent on it
};

/// Twice the log likelihood that is lost when an unknown is held at a value and all others are
/// refitted (>= 0, 0 at the best value).
using Deviance = std::function<double(double unknown)>;

/// Steps from `best` towards `bound` until the deviance is `wanted`, within 2 % of it. The root of
/// a deviance is straight where the model is linear, so a first step of about the right length is
/// corrected by a secant on the roots.
ProfileEnd profile_end(const Deviance& deviance, double best, double bound, double step,
                       double wanted);

/// Twice the log likelihood that separates a 95 % interval of one parameter: the chi-squared
/// quantile of one degree of freedom (Wilks 1938).
inline constexpr double deviance95 = 3.841;

/// 1/2 sum of squares: a fit's cost and what its priors add, each by its own deviation. A fit
/// itself minimises the priors times the square of its spread, so the two differ where that is
/// above 1.
double objective(const FitSummary& fit);

/// The interval of one free parameter of a fit by profile likelihood (Venzon and Moolgavkar 1988):
/// the parameter is held one step away, the others are refitted.
struct Profile {
  ProfileEnd low, high;
  std::optional<FitSummary> better;  ///< a refit fitted better: start from it again
};
/// `wanted`: deviance of the ends. `fit` must have been made with the same options.
Profile profile(ResidualSource& evaluator, const FitSummary& fit, int parameter,
                const FitOptions& options, double wanted = deviance95);

}  // namespace pedicel::discrepancy
