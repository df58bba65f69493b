#pragma once

#include <Eigen/Dense>
#include <vector>

#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

/// How far unknowns are moved for a difference.
struct DifferenceRule {
  /// Noise units, in all. In a narrow valley two columns that are alike but for a hundredth are
  /// compared, and the second order of a swing's phase counts: with 5 a gradient's fit ended up to
  /// 3 nats above its minimum, with 0.3 within 0.1 of it and in half the steps. With 0.05 what
  /// Newton leaves is seen.
  double wanted_change = 0.3;
  double first = 0.01, least = 1.0e-6, most = 0.05;  ///< of an unknown
  /// From one difference to the next: beyond a contact that begins nothing can be told from before
  /// it.
  double most_growth = 1.0e12;
  /// Density is moved together with modulus.
  bool pairs = true;
  Eigen::VectorXd own_least{};  ///< of each unknown, in place of `least`; empty: `least`
};

/// Derivatives of whitened predictions by a model's unknowns, from simulations side by side, each
/// moved so far that the prediction changes by a few noise units in all. Where the rule pairs them,
/// density is moved together with modulus: a free vibration sees only their ratio, and two large
/// differences would leave more of their own error than of what the data say of both together.
class Differences {
 public:
  explicit Differences(const Hypothesis& model, DifferenceRule rule = {});
  /// Sized for a model whose derivatives are known, or those by its first unknowns.
  Differences(const Hypothesis& model, const Eigen::MatrixXd& jacobian, DifferenceRule rule = {});

  /// The model at these unknowns, then moved along each direction, within its bounds.
  std::vector<Hypothesis> points(const Eigen::VectorXd& unknowns);
  /// From the residuals at points(), one column each: residual = data - prediction. The next
  /// points() are moved as far as these derivatives ask for.
  Eigen::MatrixXd jacobian(const Eigen::MatrixXd& residuals);
  /// Whether the last points() were moved about as far as they should be.
  bool suited() const;

 private:
  void resize(const Eigen::MatrixXd& along);
  double least(int p) const {
    return rule_.own_least.size() > 0 ? rule_.own_least[p] : rule_.least;
  }

  DifferenceRule rule_;
  Hypothesis model_;
  int modulus_ = -1, density_ = -1;  // unknowns, where both are free
  Eigen::MatrixXd directions_;       // one a column
  Eigen::VectorXd size_, step_;      // of the next points(), and of the last
};

}  // namespace pedicel::discrepancy
