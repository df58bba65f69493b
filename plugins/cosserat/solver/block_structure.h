#pragma once

#include <vector>

#include "plugins/cosserat/model/rod_model.h"

namespace pedicel::cosserat {

/// Where the Cholesky factor of a plant's system has 6x6 blocks: the symbolic phase of the block
/// elimination (George & Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981).
///
/// The element with the fewest neighbours and children left is eliminated next, and the last one of
/// equals (minimum degree, children before parents where that costs nothing). In a tree this is the
/// order from the last element to the first, and each element has one block, towards its parent: no
/// fill. A weld adds blocks along the paths that it joins, and so does a strand; one strand between
/// two trees makes them one, without fill.
///
/// What comes off a plant only empties blocks, so the structure made from the whole plant lasts.
class BlockStructure {
 public:
  explicit BlockStructure(const RodModel& model);

  /// A block of the factor outside its diagonal. Rows: the element eliminated first; columns:
  /// `row`, eliminated later.
  struct Entry {
    int row = 0;
    int block = 0;  ///< index of its storage
  };

  /// An element with the blocks of the factor that its elimination fills.
  struct Column {
    int element = 0;
    int begin = 0, end = 0;  ///< into `entries`
  };

  /// A block of the matrix that is not added up where the factor has it: couplings to parents that
  /// are eliminated before their children, welds, and strands.
  struct Move {
    int from = 0, to = 0;
    bool transposed = false;
  };

  std::vector<Column> columns;  ///< in the order of elimination
  std::vector<Entry> entries;   ///< of a column: in the order of elimination
  /// Blocks from which an elimination subtracts the products of its blocks i and j >= i, in this
  /// order.
  std::vector<int> targets;
  std::vector<Move> moves;  ///< before the first elimination

  /// Storage: the diagonal blocks, the couplings to the parents (unused where that is the clamp),
  /// the welds, the strands, then what else the factor has.
  int diagonal(int element) const { return element; }
  int coupling(int element) const { return elements_ + element; }
  int weld(int index) const { return 2 * elements_ + index; }
  int strand(int index) const { return weld(welds_) + index; }
  int blocks() const { return blocks_; }

 private:
  void order(const RodModel& model);
  void number_blocks(const RodModel& model);
  void add_move(int from, int row, int column);
  int block_of(int first, int later) const;

  std::vector<int> place_;  // in `columns`, of each element
  int elements_ = 0, welds_ = 0, blocks_ = 0;
};

}  // namespace pedicel::cosserat
