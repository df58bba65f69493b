#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <span>

#include "plugins/discrepancy/simulate/data_set.h"

namespace pedicel::discrepancy {

/// What the change that a cause makes to the prediction gains (nats) in its own place, and what it
/// would gain as a decoy: run backwards in time, or shown by each marker's neighbour. A cause that
/// has to do with how the plant was driven, and with where it is seen, loses that way.
struct Decoys {
  double own = 0.0, reversed = 0.0, exchanged = 0.0;
  /// Where a decoy is like the change itself, noise alone may put it ahead by some nats.
  bool lose(double margin) const { return std::max(reversed, exchanged) < own + margin; }
};

/// `residual` is the base's over these trials, whitened; `change` what the cause adds to the
/// prediction, in the same layout. A decoy that is nearly the change itself (a marker's constant
/// offset, reversed; its cosine above `too_alike`) shows nothing and gains nothing.
Decoys decoys_of(const DataSet& data, std::span<const int> trials, const Eigen::VectorXd& residual,
                 const Eigen::VectorXd& change, double too_alike);

/// The same of a change whose decoys are at hand.
Decoys decoys_of(const Eigen::VectorXd& residual, const Eigen::VectorXd& change,
                 const Eigen::VectorXd& reversed, const Eigen::VectorXd& exchanged,
                 double too_alike);

}  // namespace pedicel::discrepancy
