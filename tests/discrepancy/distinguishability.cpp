#include "tests/discrepancy/distinguishability.h"

#include <algorithm>
#include <cmath>

namespace pedicel::hidden {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_new = 1e-6;  // of a column that the others contain this share is rounding
constexpr int sweeps = 50;

VectorXd across(const MatrixXd& basis, const VectorXd& v) {
  return v - basis * (basis.transpose() * v);
}

// What the columns span besides `known`, orthonormal.
MatrixXd basis_of(const MatrixXd& columns, const MatrixXd& known) {
  MatrixXd basis(columns.rows(), columns.cols());
  long kept = 0;
  for (long c = 0; c < columns.cols(); ++c) {
    VectorXd rest = columns.col(c);
    for (int twice = 0; twice < 2; ++twice)  // Gram-Schmidt loses digits the first time
      rest = across(basis.leftCols(kept), across(known, rest));
    if (rest.norm() > least_new * columns.col(c).norm()) basis.col(kept++) = rest.normalized();
  }
  return basis.leftCols(kept);
}

// The length of v_0 - sum share_i v_i, each share between 0 and 1, at its least, from the inner
// products of the vectors; one share after the other.
double least_length(const MatrixXd& inner) {
  VectorXd weight = VectorXd::Zero(inner.rows());
  weight[0] = 1.0;
  for (int k = 0; k < sweeps; ++k)
    for (long i = 1; i < weight.size(); ++i)
      if (inner(i, i) > 0.0)
        weight[i] = std::clamp(weight[i] - inner.row(i).dot(weight) / inner(i, i), -1.0, 0.0);
  return std::sqrt(std::max(0.0, weight.dot(inner * weight)));
}

}  // namespace

Distinguishability::Distinguishability(const MatrixXd& columns,
                                       const std::vector<VectorXd>& conventions,
                                       const std::vector<OtherCause>& causes, const Change& change)
    : columns_(basis_of(columns, MatrixXd(columns.rows(), 0))),
      conventions_(columns.rows(), static_cast<long>(conventions.size())) {
  for (std::size_t i = 0; i < conventions.size(); ++i)
    conventions_.col(static_cast<long>(i)) = across(columns_, conventions[i]);
  ways_.push_back({"", MatrixXd(columns.rows(), 0)});
  for (const OtherCause& cause : causes)
    for (const std::vector<plant::Effect>& effects : cause.ways) {
      MatrixXd changes(columns.rows(), static_cast<long>(effects.size()));
      for (std::size_t i = 0; i < effects.size(); ++i)
        changes.col(static_cast<long>(i)) = change({effects[i]});
      if (changes.allFinite()) ways_.push_back({cause.name, basis_of(changes, columns_)});
    }
}

Distinguishability::Nearest Distinguishability::nearest(const VectorXd& change) const {
  MatrixXd vectors(change.size(), 1 + conventions_.cols());
  vectors << across(columns_, change), conventions_;
  const MatrixXd all = vectors.transpose() * vectors;
  Nearest nearest{least_length(all), ""};
  for (const Way& way : ways_) {
    const MatrixXd spanned = way.basis.transpose() * vectors;
    const double here = least_length(all - spanned.transpose() * spanned);
    if (here < nearest.distance) nearest = {here, way.cause};
  }
  return nearest;
}

}  // namespace pedicel::hidden
