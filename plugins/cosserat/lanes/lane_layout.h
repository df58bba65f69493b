#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "plugins/cosserat/lanes/lanes.h"
#include "plugins/cosserat/lanes/loop_shape.h"
#include "plugins/cosserat/model/rod_model.h"

namespace pedicel::cosserat {

/// A row and a lane of it.
struct Slot {
  int row = -1, lane = 0;
};

/// Lanes of a pack, from `begin` to before `end`.
struct LaneRun {
  int pack = -1, begin = 0, end = 0;
};

/// A path of elements, each the parent of the next: where a plant forks, the child of the same
/// organ goes on, else the one with the longest path below it, and the others start chains of their
/// own. So equal branches are equal chains, and a stem does not go on into the last of them. The
/// few long stems of a large plant are cut, each piece a chain that starts from the one below. The
/// first piece would have to wait for all others: it is eliminated the other way round, from the
/// clamp to its last element, where all of the plant comes together.
struct Chain {
  int plant = 0;
  std::vector<int> elements;  // from the root outward
  int parent = -1;            // index of the chain that it starts from; -1: the clamp
  int from = -1;              // that chain's element
  int level = 0;              // 0: nothing branches off; else one more than the highest branch
  bool from_clamp = false;    // a cut stem's first piece: eliminated from the clamp outward
  // Where it is no path, but a part with loops: its shape, and its welds in the model.
  const LoopShape* loops = nullptr;
  std::vector<int> welds;
  int pack = -1, lane = 0;
};

/// Which element stands in which row and lane. Chains of the same level, of any plant, stand side
/// by side in packs of up to eight; a plant of one stem and five equal branches thus fills six
/// lanes, and a row of equal plants fills all. What an element gets does not depend on its place
/// here, and how a plant is cut depends on nothing but the plant.
///
/// A part with loops (LoopPart), such as a leaf, is a chain too, and stands beside others of its
/// shape. A plant with a part that is too large is solved by a block system.
class LaneLayout {
 public:
  /// With `keep_blocks` no plant is eliminated row by row.
  LaneLayout(std::span<const RodModel* const> plants, bool keep_blocks);

  int rows() const { return static_cast<int>(elements_.size()); }
  const std::vector<Chain>& chains() const { return chains_; }
  /// Chains in the order of their first elements.
  std::span<const int> chains_of_plant(int plant) const { return chains_of_plant_[plant]; }
  /// Where they stand, in an order that depends on nothing but the plant.
  std::span<const LaneRun> lanes_of_plant(int plant) const { return lanes_of_plant_[plant]; }
  Slot slot(int plant, int element) const { return slots_[plant][element]; }

  /// Which elements, of the plants of its lanes, stand in a row; -1: none.
  const std::array<int, lane_count>& elements(int row) const { return elements_[row]; }
  /// Branches stand before what carries them, but for what starts at a first piece's end.
  int packs() const { return static_cast<int>(keeps_blocks_.size()); }
  int first_row(int pack) const { return first_row_[pack]; }
  int end_row(int pack) const { return end_row_[pack]; }
  /// Packs of plants that a block system solves hold nothing else: they are not eliminated row by
  /// row.
  bool keeps_blocks(int pack) const { return keeps_blocks_[pack]; }
  bool plant_keeps_blocks(int plant) const {
    return !lanes_of_plant_[plant].empty() && keeps_blocks(lanes_of_plant_[plant].front().pack);
  }
  /// nullptr: the pack's rows are paths.
  const LoopShape* loops(int pack) const { return loops_[pack]; }
  /// The chains of such packs have all the same length.
  bool from_clamp(int pack) const { return last_row_task_[pack] >= 0; }

  /// The elimination's tasks: the packs, then the last row of each that is eliminated from the
  /// clamp.
  int tasks() const { return packs() + static_cast<int>(packs_from_clamp_.size()); }
  bool is_pack(int task) const { return task < packs(); }
  int pack_of(int task) const { return is_pack(task) ? task : packs_from_clamp_[task - packs()]; }
  /// Whose it is.
  int task_of(int pack, int row) const {
    return from_clamp(pack) && row == end_row(pack) - 1 ? last_row_task_[pack] : pack;
  }
  /// What is eliminated into the rows of each task: packs whose chains start there, and, at a last
  /// row, the rows before it.
  std::vector<std::vector<int>> needs() const;
  /// Lays the rows of the packs out in this order: those of one thread side by side, or what a core
  /// fetches ahead belongs to another one.
  void place(std::span<const int> packs);

 private:
  void add_chains(std::vector<Chain> chains);
  const LoopShape* shared(LoopShape shape);
  void pack(const std::vector<bool>& keeps);

  std::vector<Chain> chains_;
  std::vector<std::vector<int>> chains_of_plant_;
  std::vector<std::vector<LaneRun>> lanes_of_plant_;
  std::vector<std::vector<Slot>> slots_;
  std::vector<std::array<int, lane_count>> elements_;  // by row
  std::vector<int> first_row_, end_row_;               // by pack
  std::vector<bool> keeps_blocks_;
  std::vector<const LoopShape*> loops_;  // by pack
  std::vector<std::shared_ptr<const LoopShape>> shapes_;
  std::vector<int> last_row_task_;     // by pack; -1: it has none
  std::vector<int> packs_from_clamp_;  // in order
};

}  // namespace pedicel::cosserat
