#pragma once

#include "tests/discrepancy/identifiability.h"
#include "tests/discrepancy/other_causes.h"

namespace pedicel::hidden {

/// What of a change of the data no other known cause could have made as well. To first order: sizes
/// near the smallest identifiable are small.
class Distinguishability {
 public:
  /// The change that effects make.
  using Change = std::function<Eigen::VectorXd(const std::vector<plant::Effect>&)>;

  /// `columns` are the changes by the parameters that a refit may change, `conventions` those that
  /// honest solvers may differ by; of each any share from none to all may be refitted. All are
  /// whitened channels.
  Distinguishability(const Eigen::MatrixXd& columns,
                     const std::vector<Eigen::VectorXd>& conventions,
                     const std::vector<OtherCause>& causes, const Change& change);

  struct Nearest {
    double distance = 0.0;  ///< noise units
    std::string cause;      ///< empty: the plant without any cause
  };
  /// How near the plant, alone or with one other cause, refitted, comes to a change.
  Nearest nearest(const Eigen::VectorXd& change) const;

 private:
  struct Way {
    std::string cause;
    Eigen::MatrixXd basis;  // of its changes, orthonormal, across columns_
  };

  Eigen::MatrixXd columns_;      // orthonormal
  Eigen::MatrixXd conventions_;  // across columns_
  std::vector<Way> ways_;
};

}  // namespace pedicel::hidden
