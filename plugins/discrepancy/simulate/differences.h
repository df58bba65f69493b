#pragma once

#include <Eigen/Dense>
#include <vector>

#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

/// Derivatives of whitened predictions by a model's unknowns, from simulations side by side, each
/// moved so far that the prediction changes by a few noise units in all. Density is moved together
/// with modulus: a free vibration sees only their ratio, and two large differences would leave more
/// of their own error than of what the data say of both together.
class Differences {
 public:
  explicit Differences(const Hypothesis& model);
  /// Sized for a model whose derivatives are known, or those by its first unknowns.
  Differences(const Hypothesis& model, const Eigen::MatrixXd& jacobian);

  /// The model at these unknowns, then moved along each direction, within its bounds.
  std::vector<Hypothesis> points(const Eigen::VectorXd& unknowns);
  /// From the residuals at points(), one column each: residual = data - prediction. The next
  /// points() are moved as far as these derivatives ask for.
  Eigen::MatrixXd jacobian(const Eigen::MatrixXd& residuals);
  /// Whether the last points() were moved about as far as they should be.
  bool suited() const;

 private:
  void resize(const Eigen::MatrixXd& along);

  Hypothesis model_;
  int modulus_ = -1, density_ = -1;  // unknowns, where both are free
  Eigen::MatrixXd directions_;       // one a column
  Eigen::VectorXd size_, step_;      // of the next points(), and of the last
};

}  // namespace pedicel::discrepancy
