#include "plugins/discrepancy/select/decoys.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

// Half the squared length of the residual along a direction.
double gain_along(const Eigen::VectorXd& residual, const Eigen::VectorXd& direction) {
  const double square = direction.squaredNorm();
  return square > 0.0 ? 0.5 * std::pow(residual.dot(direction), 2) / square : 0.0;
}

double decoy_gain(const Eigen::VectorXd& residual, const Eigen::VectorXd& change,
                  const Eigen::VectorXd& decoy, double too_alike) {
  const double cosine = change.dot(decoy) / std::max(change.norm() * decoy.norm(), 1e-300);
  // A change that is even in time is its own decoy, and refutes nothing.
  return std::abs(cosine) > too_alike ? 0.0 : gain_along(residual, decoy);
}

}  // namespace

Decoys decoys_of(const DataSet& data, std::span<const int> trials, const Eigen::VectorXd& residual,
                 const Eigen::VectorXd& change, double too_alike) {
  Eigen::VectorXd reversed = change, exchanged = change;
  Eigen::Index first = 0;
  for (const int t : trials) {
    const Trial& trial = data.experiment().trials[t];
    const Eigen::Index rows = trial.markers.size(), columns = trial.markers.value.cols();
    for (Eigen::Index c = 0; c < columns; ++c) {
      // By whole markers, so that x stays x.
      const Eigen::Index at = first + c * rows, neighbour = first + (c + 3) % columns * rows;
      // Backwards it has the same size and spectrum, and the wrong cause.
      reversed.segment(at, rows) = change.segment(at, rows).reverse();
      exchanged.segment(at, rows) = change.segment(neighbour, rows);
    }
    first += columns * rows;
    for (const Samples* table : {&trial.force, &trial.wrench}) {
      const Eigen::Index size = table->size();
      for (Eigen::Index c = 0; c < table->value.cols(); ++c, first += size)
        reversed.segment(first, size) = change.segment(first, size).reverse();
    }
  }
  return decoys_of(residual, change, reversed, exchanged, too_alike);
}

Decoys decoys_of(const Eigen::VectorXd& residual, const Eigen::VectorXd& change,
                 const Eigen::VectorXd& reversed, const Eigen::VectorXd& exchanged,
                 double too_alike) {
  return {gain_along(residual, change), decoy_gain(residual, change, reversed, too_alike),
          decoy_gain(residual, change, exchanged, too_alike)};
}

}  // namespace pedicel::discrepancy
