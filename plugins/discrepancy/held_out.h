#pragma once

#include <Eigen/Dense>

namespace pedicel::discrepancy {

/// How a model does on trials that it was not fitted to, against the one that it extends.
struct HeldOut {
  double gain = 0.0;      ///< log likelihood (nats)
  double expected = 0.0;  ///< of it, if the extension is right: half the squared change it makes

  /// Whether what was found shows there, too: the amplitude that the data give to the change is at
  /// least 0.6 of the one predicted, but for noise. A change too small to show refutes nothing.
  bool carries_over() const;
};

/// From the whitened residuals of both on the trials kept back; `dispersion` is the mean square
/// that even the best model leaves (1 where that is noise).
HeldOut held_out(const Eigen::VectorXd& base, const Eigen::VectorXd& extended, double dispersion);

}  // namespace pedicel::discrepancy
