#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/lanes/diagonal_blocks.h"
#include "plugins/cosserat/solver/block_system.h"
#include "plugins/cosserat/solver/newton_change.h"
#include "plugins/cosserat/solver/row_store.h"

namespace pedicel::cosserat {

/// Newton's system at the iterate and its solution, Newton's change. Trees are eliminated branches
/// before what carries them, and substituted the other way round. Plants with loops get their
/// blocks here, and bring the solution.
class RowElimination {
 public:
  explicit RowElimination(RowStore& store) : store_(store), first_extra_(store.layout.rows(), -1) {}

  /// What springs and contacts add, until clear_extras(). The blocks must stay where they are until
  /// eliminate() is done.
  void add_extras(int plant, const ElementBlocks& blocks);
  void clear_extras();

  /// The system, reduced to y and factors (trees) or left as blocks (loops).
  void eliminate(ThreadPool& pool);
  void substitute(ThreadPool& pool);
  /// One task of either, with arrays(). The tasks that they need must be done.
  void eliminate_task(const RowArrays& rows, int task);
  void substitute_task(const RowArrays& rows, int task);
  /// The rows, with what springs and contacts add.
  RowArrays arrays();

  /// The blocks of a plant with loops.
  void copy_blocks(int plant, BlockSystem& system) const;
  void set_change(int plant, const BlockSystem& solved);

  /// Whether all pivots of a plant were positive.
  bool healthy(int plant) const;
  NewtonChange change(int plant) const;
  Vec6 change(int plant, int element) const;
  /// The element with the largest change, of `elements`.
  int largest_change(int plant, int elements) const;

 private:
  void copy_element(const BlocksRow& from, int lane, int element, int parent,
                    BlockSystem& system) const;

  RowStore& store_;
  // By row, the first of its springs and contacts in extras_; -1: none.
  std::vector<int> first_extra_;
  std::vector<BlockSource> extras_;
  std::vector<int> extra_rows_;  // that have any
};

}  // namespace pedicel::cosserat
