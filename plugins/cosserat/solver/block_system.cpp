#include "plugins/cosserat/solver/block_system.h"

#include <algorithm>
#include <cmath>

namespace pedicel::cosserat {

namespace {

// The kernels below work on plain rows of six with constant bounds, so that the compiler unrolls
// and vectorises them; Eigen's general decompositions cost several times as much at this size.

// Lower Cholesky factor in place, with the inverse of the diagonal on the diagonal.
// Substitutions then multiply, and never divide: a division takes as long as several products. Only
// one half is read and written, so the other one may hold anything.
bool cholesky(Mat6& block) {
  double* a = block.data();
  for (int j = 0; j < 6; ++j) {
    double d = a[7 * j];
    for (int k = 0; k < j; ++k) d -= a[6 * j + k] * a[6 * j + k];
    // Turned round so that a NaN is refused as well: d <= 0 would let it through.
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
    // Columns innermost: six neighbours in memory, which is what a vector unit takes.
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
    // Summed beside the target and taken off once, so that the six numbers stay in registers.
    double row[6] = {};
    for (int k = 0; k < 6; ++k)
      for (int c = 0; c < 6; ++c) row[c] += v[6 * k + i] * w[6 * k + c];
    for (int c = 0; c < 6; ++c) target.data()[6 * i + c] -= row[c];
  }
}

// The factor A = L L^T of a pivot, and what its elimination does to the blocks beside it.
// Two kinds of pivot, one elimination. Newton's system is positive definite by design, and there a
// bad pivot is a fault. The exact Hessian need not be: its signs are what is asked for.
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
      // Sylvester's law of inertia: L D L^T has as many negative eigenvalues as D has negative
      // numbers. Only a pivot of zero says nothing.
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
  // D^-1 in between: there is no square root of a negative pivot to share out to both sides.
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
  // Callers fill in blocks as the plant has them, child by parent and b by a. Where the order
  // eliminates a parent first, its block has to stand the other way round.
  for (const auto& [from, to, transposed] : structure_.moves) {
    if (transposed)
      blocks_[to] += blocks_[from].transpose();
    else
      blocks_[to] += blocks_[from];
  }
}

template <class Pivot>
bool BlockSystem::eliminate() {
  // A list made once says which block each product goes to, in the very order of these loops.
  // Searching for the block would take longer than the product.
  const int* target = structure_.targets.data();
  for (const auto& [e, begin, end] : structure_.columns) {
    Mat6& pivot = blocks_[structure_.diagonal(e)];
    if (!Pivot::factorise(pivot)) return false;
    // The right side goes along with the elimination, so that only the way back is left for later.
    Pivot::reduce(pivot, right_[e]);
    // All blocks of the column first: each of the products below needs two of them.
    for (int i = begin; i < end; ++i) Pivot::reduce(pivot, blocks_[structure_.entries[i].block]);
    for (int i = begin; i < end; ++i) {
      const auto [row, block] = structure_.entries[i];
      const auto& weighted = Pivot::weighted(pivot, blocks_[block]);
      // From i on: the product of j and i is the transposed one, and the matrix is symmetric.
      for (int j = i; j < end; ++j)
        subtract_product(weighted, blocks_[structure_.entries[j].block], blocks_[*target++]);
      right_[row].noalias() -= weighted.transpose() * right_[e];
    }
  }
  return true;
}

void BlockSystem::substitute() {
  // The last one eliminated has no other left, and is known first. Of a row only the blocks towards
  // later columns were kept, all of which are solved by now.
  for (auto column = structure_.columns.rbegin(); column != structure_.columns.rend(); ++column) {
    Vec6& x = right_[column->element];
    for (int i = column->begin; i < column->end; ++i) {
      const auto [row, block] = structure_.entries[i];
      // The block was reduced by L^-1 as the right side was, so that the product needs no factor of
      // its own.
      x.noalias() -= blocks_[block] * right_[row];
    }
    backward(blocks_[structure_.diagonal(column->element)], x);
  }
}

int BlockSystem::negative_eigenvalues() const {
  // A copy: the factorisation overwrites its blocks, and the caller's are kept.
  BlockSystem factor = *this;
  factor.place_blocks();
  // A shift far below every stiffness that matters keeps singular directions (an eigenvalue of
  // zero) from stopping the factorisation.
  double largest = 0.0;
  // Blocks 0 to n - 1 are the diagonal ones. Compared with the largest stiffness there, since what
  // counts as zero is a matter of rounding, and rounding of the scale of the matrix.
  for (std::size_t e = 0; e < right_.size(); ++e)
    largest = std::max(largest, blocks_[e].diagonal().cwiseAbs().maxCoeff());
  for (std::size_t e = 0; e < right_.size(); ++e)
    factor.blocks_[e].diagonal().array() += 1.0e-14 * largest;
  // One is enough: who asks wants to know whether there is any.
  if (!factor.eliminate<IndefinitePivot>()) return 1;  // a zero pivot: not positive definite
  int count = 0;
  for (std::size_t e = 0; e < right_.size(); ++e)
    count += static_cast<int>((factor.blocks_[e].diagonal().array() < 0.0).count());
  return count;
}

}  // namespace pedicel::cosserat
