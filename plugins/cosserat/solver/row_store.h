#pragma once

#include <array>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "engine/core/task_graph.h"
#include "engine/core/thread_pool.h"
#include "plugins/cosserat/lanes/lane_layout.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/row_scratch.h"

namespace pedicel::cosserat {

/// Where a tree of a plant is clamped, at a step's start and end. A plant is one tree; plants that
/// are solved as one (Canopy) have several.
struct Clamp {
  int first_element = 0;  ///< of the tree; the trees of a plant stand one after another
  Pose before, now;       ///< X_W
};
/// That of a plant of one tree.
inline Clamp own_clamp(const RodState& state) {
  return {0, state.previous_root, state.root};
}

/// All rows of some plants (lanes.h), where each element stands, and which thread works on what.
/// What the rows hold is the business of RowStates, RowExtensions, RowElimination and RowSearch,
/// which share one store. Tasks are those of LaneLayout.
struct RowStore {
  /// What stands in a lane of a pack's first row: an element of the same plant. -1: the clamp.
  struct Anchor {
    int plant = -1, element = -1;
    int first = -1;  // of the lane's own elements
  };
  /// An element that a chain of another pack starts from, and the slot of that pack's first row.
  struct Carrier {
    Slot element, anchor;
  };

  /// With `keep_blocks` trees are treated as plants with loops are. `threads` is how many the packs
  /// are shared out to.
  RowStore(std::span<const RodModel* const> plants, int threads, bool keep_blocks,
           std::shared_ptr<RowScratch> scratch);
  RowStore(const RowStore&) = delete;
  RowStore& operator=(const RowStore&) = delete;

  /// Where the rows are, as the kernels take them.
  RowArrays arrays();

  /// Which plants the calls of all that share the store are for, until told otherwise (others may
  /// be computed along, without effect).
  void set_active(std::span<const char> plants);
  /// todo(pack) for all packs, each in the thread that has its rows.
  template <class Do>
  void each_pack(ThreadPool& pool, const Do& todo) {
    graph.each(pool, [&](int task) {
      if (layout.is_pack(task)) todo(task);
    });
  }

  /// Where the tree that begins with a lane's first element is clamped.
  const Clamp& clamp_of(const Anchor& anchor) const;
  /// The parents' poses into a pack's first row: theirs must have been moved already.
  void place_anchors(int pack, std::span<PoseRow> poses) const;
  /// The iterate's, where it has just been made, which does not wait for parents.
  void take_anchors(int pack);
  /// To the first rows of the packs that a task carries: each of them would fetch eight times as
  /// much from all over this one, perhaps out of another core's cache.
  void pass_on_changes(int task);
  void pass_on_poses(int task);

  /// Makes the rows of viscous terms, where there are none yet, and has a pack use them.
  void make_viscous(int pack);
  /// Makes the rows of extensions, with so many branches a joint at least. Returns whether what was
  /// read into them is lost.
  bool make_extensions(int branches);

  /// Adds what a step reads of what was left by the one before.
  void add_to(FetchAhead& ahead) const;
  /// What is fetched along with the rows of the next step; null: nothing.
  void fetch_along(FetchAhead* ahead);

  std::shared_ptr<RowScratch> scratch;
  LaneLayout layout;
  TaskGraph graph;  // of the layout's tasks
  std::vector<Pack> packs;
  std::pmr::vector<ElementRow> element;
  std::pmr::vector<PoseRow> previous;
  std::pmr::vector<RateRow> previous_rate;  // between a step's finish and its end the end's
  std::pmr::vector<StrainRow> previous_strain;

  // Empty unless some plant is extended.
  std::vector<ExtensionRow> extension;
  std::vector<ExtensionTermRow> extension_term;
  std::vector<BranchRow> law_branch;     // `law_branches_a_row` a row
  std::vector<JointTermRow> joint_term;  // empty unless some joint has a term
  int law_branches_a_row = 0;
  std::vector<WeldRow> weld;  // of loop parts, Pack::first_weld

  // Packs that are eliminated into elements of others, by row: BlockSource lists.
  std::vector<int> first_branch;
  std::vector<BlockSource> branches;
  std::vector<std::array<Anchor, lane_count>> anchors;  // by pack
  std::vector<std::vector<Carrier>> carriers;           // by task
  std::vector<std::vector<Clamp>> clamps;               // by plant, of its trees in order

  Vec3 gravity = Vec3::Zero();  // m/s2, W
  /// 1, by how much of the way the axes that drag is linearised about go to the iterate's.
  double axis_share = 1.0;
  FetchAhead* ahead = nullptr;  // not its own

 private:
  void make_packs();
  void make_loops();
  void join_chains();

  std::vector<char> active_plants_, active_;  // set_active(); by pack
};

}  // namespace pedicel::cosserat
