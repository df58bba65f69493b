#pragma once

#include <Eigen/Dense>
#include <vector>

namespace pedicel::app {

/// Two neighbouring samples and how far between them; the first or last one beyond the ends.
struct BetweenSamples {
  Eigen::Index low = 0, high = 0;
  double share = 0.0;

  /// A row of a table there; NaN where either of the two is.
  Eigen::RowVectorXd row(const Eigen::MatrixXd& table) const;
};

/// `time` (s) rises and is not empty.
BetweenSamples between_samples(const std::vector<double>& time, double t);

}  // namespace pedicel::app
