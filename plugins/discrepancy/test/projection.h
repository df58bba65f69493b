#pragma once

#include <Eigen/Dense>

#include "plugins/discrepancy/simulate/noise.h"

namespace pedicel::discrepancy {

/// A number (or the length of a vector) with its standard error.
struct Measured {
  double value = 0.0, error = 0.0;
};

/// Unknowns b of residual = regressors b + noise, by generalised least squares (Aitken): both sides
/// are whitened, so that coloured noise neither biases the errors nor the weights.
class Projection {
 public:
  explicit Projection(int unknowns);

  /// One channel: `regressors` has a row a sample. Samples with a NaN on either side count as gaps.
  /// `Constant::free`: the channel has a constant of its own besides.
  enum class Constant { none, free };
  void add(const Series& residual, const Eigen::MatrixXd& regressors, const Noise& noise,
           Constant constant = Constant::none);

  struct Result {
    Eigen::VectorXd value;
    Eigen::MatrixXd covariance;
    double explained = 0.0;  ///< share of the whitened sum of squares
    double scatter = 0.0;    ///< RMS of what is left, 1 where it is noise
    int samples = 0;
    Measured component(int i) const;
    /// Length of `count` components from `first`, with the error along their own direction.
    Measured length(int first, int count) const;
  };
  /// False where the regressors leave an unknown open.
  bool solve(Result& result) const;

 private:
  Eigen::MatrixXd information_;
  Eigen::VectorXd right_;
  double squares_ = 0.0;
  int samples_ = 0;
};

/// Length of a vector with independent components, and its error along the vector.
Measured length_of(const Eigen::VectorXd& vector, const Eigen::VectorXd& errors);

/// Standard deviation of sum(weights x noise), for stationary noise that also acted before the
/// first weight.
double projected_std(const Eigen::VectorXd& weights, const Noise& noise);

/// Autocorrelations at lags 0 to `lags`.
std::vector<double> autocorrelation(const Noise& noise, int lags);

}  // namespace pedicel::discrepancy
