#pragma once

#include <array>
#include <span>
#include <vector>

#include "cosserat/lanes.h"
#include "cosserat/rod_model.h"

namespace pedicel::cosserat {

/// A row and a lane of it.
struct Slot {
  int row = -1, lane = 0;
};

/// A path of elements, each the parent of the next: where a plant forks, the child of the same
/// organ goes on, else the one with the longest path below it, and the others start chains of their
/// own. So equal branches are equal chains, and a stem does not go on into the last of them.
struct Chain {
  int plant = 0;
  std::vector<int> elements;  // from the root outward
  int parent = -1;            // index of the chain that it starts from; -1: the clamp
  int level = 0;              // 0: nothing branches off; else one more than the highest branch
  int pack = -1, lane = 0;
};

/// Which element stands in which row and lane. Chains of the same level, of any plant, stand side
/// by side in packs of up to eight; a plant of one stem and five equal branches thus fills six
/// lanes, and a row of equal plants fills all.
///
/// For threads the packs fall into groups that depend on nothing but the last one, `top`: whole
/// plants where they can be shared out evenly, else the branches of the largest, with the stems
/// that carry them on top. What an element gets does not depend on its place here.
class LaneLayout {
 public:
  /// `threads` >= 1. With `keep_blocks` no plant is eliminated row by row.
  LaneLayout(std::span<const RodModel* const> plants, int threads, bool keep_blocks);

  int rows() const { return static_cast<int>(elements_.size()); }
  const std::vector<Chain>& chains() const { return chains_; }
  /// Chains in the order of their first elements.
  std::span<const int> chains_of_plant(int plant) const { return chains_of_plant_[plant]; }
  Slot slot(int plant, int element) const { return slots_[plant][element]; }

  /// Which elements, of the plants of its lanes, stand in a row; -1: none.
  const std::array<int, lane_count>& elements(int row) const { return elements_[row]; }
  int packs() const { return static_cast<int>(keeps_blocks_.size()); }
  int first_row(int pack) const { return first_row_[pack]; }
  int end_row(int pack) const { return first_row_[pack + 1]; }
  /// Packs of plants with loops hold nothing else: they are not eliminated row by row.
  bool keeps_blocks(int pack) const { return keeps_blocks_[pack]; }

  /// Packs of a group, branches before what carries them. The last group is `top`.
  int groups() const { return static_cast<int>(group_begin_.size()) - 1; }
  int group_begin(int group) const { return group_begin_[group]; }
  int group_end(int group) const { return group_begin_[group + 1]; }

 private:
  void add_chains(const RodModel& model, int plant);
  std::vector<std::vector<int>> share_out(int threads) const;
  void pack(std::vector<int> chains, const std::vector<bool>& keeps);

  std::vector<Chain> chains_;
  std::vector<std::vector<int>> chains_of_plant_;
  std::vector<std::vector<Slot>> slots_;
  std::vector<std::array<int, lane_count>> elements_;  // by row
  std::vector<int> first_row_{0}, group_begin_{0};
  std::vector<bool> keeps_blocks_;
};

}  // namespace pedicel::cosserat
