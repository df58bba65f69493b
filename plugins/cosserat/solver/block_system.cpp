#include "pedicel/cosserat/solver/block_system.h"

#include <algorithm>
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

// T <- T - V^T W
void subtract_product(const Mat6& left, const Mat6& right, Mat6& target) {
  const double* v = left.data();
  const double* w = right.data();
  for (int i = 0; i < 6; ++i) {
    double row[6] = {};
    for (int k = 0; k < 6; ++k)
      for (int c = 0; c < 6; ++c) row[c] += v[6 * k + i] * w[6 * k + c];
    for (int c = 0; c < 6; ++c) target.data()[6 * i + c] -= row[c];
  }
}

// The factor A = L L^T of a pivot, and what its elimination does to the blocks beside it.
struct CholeskyPivot {
  static bool factorise(Mat6& pivot) { return cholesky(pivot); }
  template <class Block>
  static void reduce(const Mat6& pivot, Block& block) {
    forward(pivot, block);
  }
  static const Mat6& weighted(const Mat6&, const Mat6& block) { return block; }
};

// The same with A = L D L^T, unit L below and D on the diagonal, for matrices that are not positive
// definite. Without pivoting: exact in its signs wherever no pivot vanishes.
struct IndefinitePivot {
  static bool factorise(Mat6& pivot) {
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < j; ++k) pivot(j, j) -= pivot(j, k) * pivot(j, k) * pivot(k, k);
      if (pivot(j, j) == 0.0) return false;
      for (int i = j + 1; i < 6; ++i) {
        for (int k = 0; k < j; ++k) pivot(i, j) -= pivot(i, k) * pivot(k, k) * pivot(j, k);
        pivot(i, j) /= pivot(j, j);
      }
    }
    return true;
  }
  template <class Block>
  static void reduce(const Mat6& pivot, Block& block) {
    pivot.triangularView<Eigen::UnitLower>().solveInPlace(block);
  }
  static Mat6 weighted(const Mat6& pivot, const Mat6& block) {
    return pivot.diagonal().cwiseInverse().asDiagonal() * block;
  }
};

}  // namespace

BlockSystem::BlockSystem(const RodModel& model)
    : structure_(model), blocks_(structure_.blocks()), right_(model.elements.size()) {
  clear();
}

void BlockSystem::clear() {
  for (Mat6& block : blocks_) block.setZero();
  for (Vec6& vector : right_) vector.setZero();
}

bool BlockSystem::solve() {
  place_blocks();
  if (!eliminate<CholeskyPivot>()) return false;
  substitute();
  return true;
}

void BlockSystem::place_blocks() {
  for (const auto& [from, to, transposed] : structure_.moves) {
    if (transposed)
      blocks_[to] += blocks_[from].transpose();
    else
      blocks_[to] += blocks_[from];
  }
}

template <class Pivot>
bool BlockSystem::eliminate() {
  const int* target = structure_.targets.data();
  for (const auto& [e, begin, end] : structure_.columns) {
    Mat6& pivot = blocks_[structure_.diagonal(e)];
    if (!Pivot::factorise(pivot)) return false;
    Pivot::reduce(pivot, right_[e]);
    for (int i = begin; i < end; ++i) Pivot::reduce(pivot, blocks_[structure_.entries[i].block]);
    for (int i = begin; i < end; ++i) {
      const auto [row, block] = structure_.entries[i];
      const auto& weighted = Pivot::weighted(pivot, blocks_[block]);
      for (int j = i; j < end; ++j)
        subtract_product(weighted, blocks_[structure_.entries[j].block], blocks_[*target++]);
      right_[row].noalias() -= weighted.transpose() * right_[e];
    }
  }
  return true;
}

void BlockSystem::substitute() {
  for (auto column = structure_.columns.rbegin(); column != structure_.columns.rend(); ++column) {
    Vec6& x = right_[column->element];
    for (int i = column->begin; i < column->end; ++i) {
      const auto [row, block] = structure_.entries[i];
      x.noalias() -= blocks_[block] * right_[row];
    }
    backward(blocks_[structure_.diagonal(column->element)], x);
  }
}

int BlockSystem::negative_eigenvalues() const {
  BlockSystem factor = *this;
  factor.place_blocks();
  // A shift far below every stiffness that matters keeps singular directions (an eigenvalue of
  // zero) from stopping the factorisation.
  double largest = 0.0;
  for (std::size_t e = 0; e < right_.size(); ++e)
    largest = std::max(largest, blocks_[e].diagonal().cwiseAbs().maxCoeff());
  for (std::size_t e = 0; e < right_.size(); ++e)
    factor.blocks_[e].diagonal().array() += 1.0e-14 * largest;
  if (!factor.eliminate<IndefinitePivot>()) return 1;  // a zero pivot: not positive definite
  int count = 0;
  for (std::size_t e = 0; e < right_.size(); ++e)
    count += static_cast<int>((factor.blocks_[e].diagonal().array() < 0.0).count());
  return count;
}

}  // namespace pedicel::cosserat
