#include "cosserat/block_system.h"

#include <cmath>

namespace pedicel::cosserat {

namespace {

// The kernels below work on plain rows of six with constant bounds, so that the compiler unrolls
// and vectorises them; Eigen's general decompositions cost several times as much at this size.

// Lower Cholesky factor in place, with the inverse of the diagonal on the diagonal.
bool cholesky(Mat6& block) {
  double* a = block.data();
  for (int j = 0; j < 6; ++j) {
    double d = a[7 * j];
    for (int k = 0; k < j; ++k) d -= a[6 * j + k] * a[6 * j + k];
    if (!(d > 0.0)) return false;
    const double inverse = 1.0 / std::sqrt(d);
    a[7 * j] = inverse;
    for (int i = j + 1; i < 6; ++i) {
      double s = a[6 * i + j];
      for (int k = 0; k < j; ++k) s -= a[6 * i + k] * a[6 * j + k];
      a[6 * i + j] = s * inverse;
    }
  }
  return true;
}

// W <- L^-1 W
void forward(const Mat6& factor, Mat6& block) {
  const double* l = factor.data();
  double* w = block.data();
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k)
      for (int c = 0; c < 6; ++c) w[6 * i + c] -= l[6 * i + k] * w[6 * k + c];
    for (int c = 0; c < 6; ++c) w[6 * i + c] *= l[7 * i];
  }
}

// y <- L^-1 y
void forward(const Mat6& factor, Vec6& vector) {
  const double* l = factor.data();
  for (int i = 0; i < 6; ++i) {
    double s = vector[i];
    for (int k = 0; k < i; ++k) s -= l[6 * i + k] * vector[k];
    vector[i] = s * l[7 * i];
  }
}

// x <- L^-T x
void backward(const Mat6& factor, Vec6& vector) {
  const double* l = factor.data();
  for (int i = 5; i >= 0; --i) {
    double s = vector[i];
    for (int k = i + 1; k < 6; ++k) s -= l[6 * k + i] * vector[k];
    vector[i] = s * l[7 * i];
  }
}

// P <- P - W^T W
void subtract_product(const Mat6& block, Mat6& parent) {
  const double* w = block.data();
  double* p = parent.data();
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 6; ++i)
      for (int c = 0; c < 6; ++c) p[6 * i + c] -= w[6 * k + i] * w[6 * k + c];
}

}  // namespace

BlockSystem::BlockSystem(const RodModel& model) {
  for (const Element& element : model.elements) parent_.push_back(element.parent);
  for (const Weld& weld : model.welds) weld_ends_.emplace_back(weld.a, weld.b);
  diagonal_.resize(parent_.size());
  coupling_.resize(parent_.size());
  right_.resize(parent_.size());
  weld_.resize(weld_ends_.size());
  clear();
}

void BlockSystem::clear() {
  for (Mat6& block : diagonal_) block.setZero();
  for (Mat6& block : coupling_) block.setZero();
  for (Mat6& block : weld_) block.setZero();
  for (Vec6& vector : right_) vector.setZero();
}

bool BlockSystem::solve() {
  if (!weld_ends_.empty()) return solve_sparse();
  if (!eliminate()) return false;
  substitute();
  return true;
}

bool BlockSystem::eliminate() {
  for (int e = static_cast<int>(parent_.size()) - 1; e >= 0; --e) {
    if (!cholesky(diagonal_[e])) return false;
    forward(diagonal_[e], right_[e]);
    const int p = parent_[e];
    if (p < 0) continue;
    forward(diagonal_[e], coupling_[e]);
    subtract_product(coupling_[e], diagonal_[p]);
    right_[p].noalias() -= coupling_[e].transpose() * right_[e];
  }
  return true;
}

void BlockSystem::substitute() {
  for (std::size_t e = 0; e < parent_.size(); ++e) {
    if (parent_[e] >= 0) right_[e].noalias() -= coupling_[e] * right_[parent_[e]];
    backward(diagonal_[e], right_[e]);
  }
}

Eigen::SparseMatrix<double> BlockSystem::sparse_matrix() const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row, int column, const Mat6& block, bool lower_only) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < (lower_only ? i + 1 : 6); ++j)
        entries.emplace_back(6 * row + i, 6 * column + j, block(i, j));
  };
  const int n = static_cast<int>(parent_.size());
  for (int e = 0; e < n; ++e) {
    add(e, e, diagonal_[e], true);
    if (parent_[e] >= 0) add(e, parent_[e], coupling_[e], false);
  }
  for (std::size_t k = 0; k < weld_ends_.size(); ++k) {
    const auto [a, b] = weld_ends_[k];
    if (a < b)
      add(b, a, weld_[k], false);
    else
      add(a, b, weld_[k].transpose(), false);
  }
  Eigen::SparseMatrix<double> matrix(6 * n, 6 * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

bool BlockSystem::solve_sparse() {
  const Eigen::SparseMatrix<double> matrix = sparse_matrix();
  if (!analysed_) factor_.analyzePattern(matrix);
  analysed_ = true;
  factor_.factorize(matrix);
  if (factor_.info() != Eigen::Success || (factor_.vectorD().array() <= 0.0).any()) return false;
  Eigen::Map<Eigen::VectorXd> all(right_.front().data(), 6 * static_cast<int>(right_.size()));
  const Eigen::VectorXd solved = factor_.solve(all);
  all = solved;
  return true;
}

int BlockSystem::negative_eigenvalues() const {
  // A shift far below every stiffness that matters keeps singular directions (an eigenvalue of
  // zero) from stopping the factorisation.
  Eigen::SparseMatrix<double> matrix = sparse_matrix();
  const double shift = 1.0e-14 * matrix.diagonal().cwiseAbs().maxCoeff();
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  factor.setShift(shift);
  factor.compute(matrix);
  if (factor.info() != Eigen::Success) return 1;  // a zero pivot: not positive definite
  return static_cast<int>((factor.vectorD().array() < 0.0).count());
}

}  // namespace pedicel::cosserat
