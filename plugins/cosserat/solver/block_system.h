#pragma once

#include <Eigen/Core>
#include <vector>

#include "plugins/cosserat/lanes/diagonal_blocks.h"
#include "plugins/cosserat/model/rod_model.h"
#include "plugins/cosserat/solver/block_structure.h"

namespace pedicel::cosserat {

/// A symmetric positive definite system with one 6x6 block an element, coupled to the parent's and,
/// where the plant has loops, across its welds, and across strands. Unknowns of an element:
/// (position, rotation vector), both in W.
///
/// Solved by a block Cholesky factorisation whose symbolic phase, BlockStructure, is made once from
/// the whole plant; nothing allocates afterwards. In a tree that is: eliminate every element into
/// its parent, leaves first, then substitute from the root, O(n); so too, with a few blocks an
/// element more, where loops are small beside the plant.
class BlockSystem {
 public:
  explicit BlockSystem(const RodModel& model);

  void clear();
  Mat6& diagonal(int element) { return blocks_[structure_.diagonal(element)]; }
  /// Rows: the element; columns: its parent. Not used where the parent is the clamp.
  Mat6& coupling(int element) { return blocks_[structure_.coupling(element)]; }
  /// Rows: the weld's b; columns: its a.
  Mat6& weld(int index) { return blocks_[structure_.weld(index)]; }
  /// Rows: the strand's b; columns: its a.
  Mat6& strand(int index) { return blocks_[structure_.strand(index)]; }
  Vec6& right_side(int element) { return right_[element]; }

  /// Overwrites the blocks with their factors. False where the matrix is not positive definite.
  bool solve();
  const Vec6& solution(int element) const { return right_[element]; }

  /// The number of negative eigenvalues, by Sylvester's law of inertia (from the signs of the
  /// pivots of LDL^T; 1 where a pivot is zero). Keeps the blocks; allocates.
  int negative_eigenvalues() const;

  const BlockStructure& structure() const { return structure_; }

 private:
  void place_blocks();
  template <class Pivot>
  bool eliminate();
  void substitute();

  BlockStructure structure_;
  std::vector<Mat6> blocks_;  // as BlockStructure numbers them
  std::vector<Vec6> right_;
};

}  // namespace pedicel::cosserat
