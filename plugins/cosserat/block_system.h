#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "cosserat/diagonal_blocks.h"
#include "cosserat/rod_model.h"

namespace pedicel::cosserat {

/// A symmetric positive definite system with one 6x6 block an element, coupled to the parent's and,
/// where the plant has loops, across its welds. Unknowns of an element: (position, rotation
/// vector), both in W.
///
/// A tree is solved in O(n) without fill: eliminating every element into its parent, leaves first,
/// then substituting from the root. With welds a general sparse factorisation (Eigen's LDL^T) is
/// used, its symbolic phase kept.
class BlockSystem {
 public:
  explicit BlockSystem(const RodModel& model);

  void clear();
  Mat6& diagonal(int element) { return diagonal_[element]; }
  /// Rows: the element; columns: its parent. Not used where the parent is the clamp.
  Mat6& coupling(int element) { return coupling_[element]; }
  /// Rows: the weld's b; columns: its a.
  Mat6& weld(int index) { return weld_[index]; }
  Vec6& right_side(int element) { return right_[element]; }

  /// Overwrites the blocks with their factors. False where the matrix is not positive definite.
  bool solve();
  const Vec6& solution(int element) const { return right_[element]; }

  /// The number of negative eigenvalues, by Sylvester's law of inertia (from the signs of the
  /// pivots of LDL^T; 1 where a pivot is zero). Slow; for stability questions only. Keeps the blocks.
  int negative_eigenvalues() const;

 private:
  bool eliminate();
  void substitute();
  bool solve_sparse();
  Eigen::SparseMatrix<double> sparse_matrix() const;

  std::vector<int> parent_;
  std::vector<std::pair<int, int>> weld_ends_;
  std::vector<Mat6> diagonal_, coupling_, weld_;
  std::vector<Vec6> right_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  bool analysed_ = false;
};

}  // namespace pedicel::cosserat
