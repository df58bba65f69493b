#pragma once

#include <optional>
#include <vector>

#include "plugins/cosserat/model/rod_model.h"

namespace pedicel::cosserat {

/// How the elements of a loop part hang together, and the order in which they are eliminated into
/// the one element that carries them all. They are numbered from 0 on, parents before children; -1
/// is what carries them. Parts of one shape stand side by side in a pack.
///
/// The next to be eliminated has the fewest neighbours left (minimum degree: George & Liu, Computer
/// Solution of Large Sparse Positive Definite Systems, 1981), the last one of equals.
class LoopShape {
 public:
  struct Joint {
    int a = -1, b = -1;
    bool operator==(const Joint&) const = default;
  };
  LoopShape(std::vector<int> parents, std::vector<Joint> welds);

  /// A block of the factor outside its diagonal. Rows: the element that is eliminated first.
  struct Entry {
    int column = -1;    ///< the element that is eliminated later
    bool half = false;  ///< its upper right quarter is zero: own place and the other's rotation
  };
  /// An element with the entries that its elimination fills.
  struct Column {
    int element = 0;
    int begin = 0, end = 0;  ///< into entries()
  };
  /// Where an elimination subtracts the product of two of its entries i < j.
  struct Target {
    int entry = 0;
    bool first = false;  ///< nothing stands there before
  };
  /// Where a coupling is put that the plant itself has.
  struct Place {
    int entry = 0;
    bool turned = false;  ///< as its transpose: the other one is eliminated first
    bool first = false;   ///< nothing stands there before
  };

  int size() const { return static_cast<int>(parents_.size()); }
  const std::vector<int>& parents() const { return parents_; }
  const std::vector<Joint>& welds() const { return welds_; }
  const std::vector<Column>& columns() const { return columns_; }  ///< in their order
  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<Target>& targets() const { return targets_; }
  /// Of each element with its parent, and of each weld's b with its a.
  const std::vector<Place>& couplings() const { return couplings_; }
  const std::vector<Place>& weld_couplings() const { return weld_couplings_; }
  bool operator==(const LoopShape& other) const {
    return parents_ == other.parents_ && welds_ == other.welds_;
  }

  /// Most elements of a part, entries, and entries of a column; a part with more has no shape.
  static constexpr int most_elements = 60, most_entries = 240, most_in_column = 12;
  bool fits() const;

 private:
  void order();
  void place_couplings();
  void place_products();
  Place place_of(int row, int column) const;
  int entry_of(int first, int later) const;

  std::vector<int> parents_;
  std::vector<Joint> welds_;
  std::vector<Column> columns_;
  std::vector<Entry> entries_;
  std::vector<Target> targets_;
  std::vector<Place> couplings_, weld_couplings_;
  std::vector<int> place_;  // in columns_, of each element and of what carries them
};

/// Elements of a plant that welds join to loops, and that hang on one element: a leaf.
struct LoopPart {
  std::vector<int> elements;  ///< in ascending order
  int from = -1;              ///< the element that carries them; -1: the clamp
  std::vector<int> welds;     ///< indices into RodModel::welds
  LoopShape shape;
};

/// All of them, in the order of their first elements: every weld is one of a part. Nothing where
/// some part is too large for LoopShape, or where the model has strands.
std::optional<std::vector<LoopPart>> loop_parts(const RodModel& model);

}  // namespace pedicel::cosserat
