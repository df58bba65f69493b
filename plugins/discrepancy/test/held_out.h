#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// How a model does on trials that it was not fitted to, against the one that it extends.
struct HeldOut {
  double gain = 0.0;      ///< log predictive density (nats)
  double expected = 0.0;  ///< of it, if the extension is right: half the squared change it makes

  /// Whether what was found shows there, too: the amplitude that the data give to the change is at
  /// least 0.6 of the one predicted, but for noise. A change too small to show refutes nothing.
  bool carries_over(const Evidence& evidence) const;
};

/// What a fitted model says of held-out trials, and how sure it is of it.
struct HeldOutModel {
  Eigen::VectorXd residual;  ///< whitened
  Eigen::MatrixXd jacobian;  ///< of the whitened prediction by the unknowns
  Eigen::MatrixXd by_data;   ///< information about the unknowns from the trials fitted to
  Eigen::VectorXd prior;     ///< and from beforehand, its diagonal
};

/// `check` names the held-out trials.
HeldOutModel held_out_model(Evaluator& evaluator, const FitSummary& model, const FitOptions& check);

/// The mean square, in that of the noise (`dispersion`), of what a model leaves of these `samples`
/// held out, weighed by the noise's covariance and what its unknowns' own adds: 1 with a standard
/// deviation of sqrt(2/samples) where it is right.
double held_out_excess(const HeldOutModel& model, int samples, double dispersion);

/// Each model's log predictive density less the base's: normal, with the noise's covariance and
/// what the unknowns' own adds (Bernardo and Smith 1994, section 5.1), so that a valley of the fit
/// (modulus and density of a free vibration) neither helps nor harms a model. `dispersion` is the
/// mean square that even the best model leaves of the trials fitted to (1 where that is noise);
/// what the best leaves of these `samples` above it raises it for them.
std::vector<HeldOut> held_out(const HeldOutModel& base, std::span<const HeldOutModel> models,
                              int samples, double dispersion);

}  // namespace pedicel::discrepancy
