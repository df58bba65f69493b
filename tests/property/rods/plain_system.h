#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plugins/cosserat/model/rod_model.h"

/// A second direct solver for the tests, written to be read: one element after the other, in double
/// precision, in the order in which the elements stand, with Eigen's own decompositions. It shares
/// the model, the state and the settings with the program's, and no equation.
namespace pedicel::plain {

using Block = Eigen::Matrix<double, 6, 6>;
using Six = Eigen::Matrix<double, 6, 1>;

/// A symmetric system with one 6x6 block an element: unknowns are an element's position and
/// rotation vector, both in W.
struct System {
  explicit System(const cosserat::RodModel& model);

  const cosserat::RodModel& model;
  std::vector<Block> diagonal;
  std::vector<Block> coupling;  ///< rows: the element; columns: its parent
  std::vector<Block> weld;      ///< rows: the weld's b; columns: its a
  std::vector<Six> right;
};

/// Its solution: from the leaves to the clamp and back where the plant is a tree, else Eigen's
/// sparse Cholesky factorisation. Empty where the matrix is not positive definite.
std::optional<std::vector<Six>> solve(const System& system);

/// The same in other ways, to check that one by.
std::optional<std::vector<Six>> solve_sparse(const System& system);
std::optional<std::vector<Six>> solve_dense(const System& system);

/// Right side less matrix times `x`.
std::vector<Six> residual(const System& system, const std::vector<Six>& x);

/// How far a residual may be from zero after an elimination in which each unknown is off by
/// `errors`: in row i the sum over an element and its neighbours of sqrt(A_ii A_jj) errors_j. L D
/// L^T of a positive definite matrix keeps |L| sqrt(D) and |L^-1 C| / sqrt(D) below the roots of
/// the diagonal (Cauchy-Schwarz), so that what rounding its factors leaves is a small multiple of
/// that however ill-conditioned the matrix (Higham, Accuracy and Stability of Numerical Algorithms,
/// section 10.1).
std::vector<Six> residual_bound(const System& system, const std::vector<Six>& errors);

}  // namespace pedicel::plain
