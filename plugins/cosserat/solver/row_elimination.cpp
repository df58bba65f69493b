#include "plugins/cosserat/solver/row_elimination.h"

#include <algorithm>

#include "plugins/cosserat/lanes/lane_kernels.h"

namespace pedicel::cosserat {

namespace {

// Symmetric blocks are kept once: memory limits the kernels, and 21 numbers in place of 36 are that
// much less to fetch.
constexpr int at(int i, int j) {  // in a lower triangle by rows
  return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
}

}  // namespace

RowArrays RowElimination::arrays() {
  // Made anew at each call: vectors of the scratch may have been swapped with those of the store
  // since, and the pointers of the last step would be to its past.
  RowArrays rows = store_.arrays();
  rows.first_extra = first_extra_.data();
  rows.extras = extras_.data();
  return rows;
}

void RowElimination::add_extras(int plant, const ElementBlocks& blocks) {
  for (std::size_t i = 0; i < blocks.elements.size(); ++i) {
    // Blocks come packed eight a row, as contacts are, and places without a block have the element
    // -1.
    if (blocks.elements[i] < 0) continue;
    const Slot slot = store_.layout.slot(plant, blocks.elements[i]);
    // A linked list by row, the newest first. Values are pointed to and not copied: between two
    // iterations the same contacts change their values in place, and the list holds.
    extras_.push_back({blocks.values[i].values.data(), 1, slot.lane, first_extra_[slot.row]});
    first_extra_[slot.row] = static_cast<int>(extras_.size()) - 1;
    extra_rows_.push_back(slot.row);
  }
}

// Only the rows that have any: they are few.
// Before `extras_`: the list says which rows those are.
void RowElimination::clear_extras() {
  for (const int row : extra_rows_) first_extra_[row] = -1;
  extra_rows_.clear();
  extras_.clear();
}

void RowElimination::eliminate(ThreadPool& pool) {
  const RowArrays rows = arrays();
  // Branches before what carries them. A stem's row can be eliminated only when each branch at it
  // has left its Schur complement there; everything else may be at once.
  store_.graph.post_order(pool, [&](int task) { eliminate_task(rows, task); });
}

void RowElimination::eliminate_task(const RowArrays& rows, int task) {
  const LaneLayout& layout = store_.layout;
  const int number = layout.pack_of(task);
  Pack& pack = store_.packs[number];
  if (!pack.active) return;
  for (const int branch : store_.graph.needs(task))  // perhaps in another core's cache
    for (const Lanes& values : store_.packs[branch].branch) __builtin_prefetch(values);
  // A task that is no pack is where the two directions of a twisted factorisation meet. Both sides
  // are done here, and the one element that is left is solved at once.
  if (!layout.is_pack(task)) {
    solve_last(rows, pack);
    return;
  }
  // The poses of a pack's parents are copies in its first row. They are taken now, at the last
  // moment, because the thread that moves the parents may have been another one.
  if (!pack.anchored) store_.take_anchors(number);
  // Three ways, by layout: plants with loops keep the blocks for the block system; a piece of a
  // stem runs outward from the clamp; all others are linearised and eliminated in one walk down the
  // rows, where a block never leaves the registers.
  if (layout.keeps_blocks(number))
    linearise(rows, pack);
  else if (pack.loops)
    eliminate_loops(rows, pack);
  else if (layout.from_clamp(number))
    eliminate_from_clamp(rows, pack);
  else
    linearise_and_eliminate(rows, pack);
}

void RowElimination::substitute(ThreadPool& pool) {
  const RowArrays rows = arrays();
  // The other way round: what carries is known before what it carries.
  store_.graph.pre_order(pool, [&](int task) { substitute_task(rows, task); });
}

// A plant with loops has its solution already, of which only the size is wanted.
void RowElimination::substitute_task(const RowArrays& rows, int task) {
  const LaneLayout& layout = store_.layout;
  const int number = layout.pack_of(task);
  Pack& pack = store_.packs[number];
  if (!pack.active) return;
  if (layout.keeps_blocks(number)) {
    measure_change(rows, pack);
    return;
  }
  if (layout.is_pack(task)) {
    if (layout.from_clamp(number))
      substitute_to_clamp(rows, pack);
    else if (pack.loops)
      substitute_loops(rows, pack);
    else
      cosserat::substitute(rows, pack);
  }
  // The branches' packs need the change of their parent's element. It is handed out here, once:
  // each pack that fetched it for itself would wait for another core's cache line.
  store_.pass_on_changes(task);
}

void RowElimination::copy_blocks(int plant, BlockSystem& system) const {
  system.clear();
  for (const int c : store_.layout.chains_of_plant(plant)) {
    const Chain& chain = store_.layout.chains()[c];
    // The first element of a chain hangs on what stands in the anchor's row: an element of another
    // chain, or -1 for the clamp. From there on the parent is the element before.
    int parent = store_.anchors[chain.pack][chain.lane].element;
    for (const int e : chain.elements) {
      const int row = store_.layout.slot(plant, e).row;
      // An empty diagonal block would be a bad pivot, and stop the factorisation of what still
      // stands. The right side stays zero, and so does the change.
      if (store_.element[row].alive[chain.lane] == 0.0)
        system.diagonal(e).setIdentity();  // what came off does not move
      else
        copy_element(store_.scratch->blocks[row], chain.lane, e, parent, system);
      parent = e;
    }
  }
}

void RowElimination::copy_element(const BlocksRow& from, int lane, int e, int parent,
                                  BlockSystem& system) const {
  // Added and not set: children come first or later in this loop, and have put their share into the
  // same diagonal block.
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) system.diagonal(e)(i, j) += from.diagonal[at(i, j)][lane];
    system.right_side(e)[i] += from.right[i][lane];
  }
  if (parent < 0) return;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // The 21 numbers of `coupling`: 6 of the symmetric quarter of places, 9 of rotation by place,
      // 6 of the symmetric quarter of rotations. Energies are of differences between the two
      // elements, so the coupling enters with a minus sign, and the same numbers with a plus are
      // the parent's own.
      const double stretch = from.coupling[at(i, j)][lane];
      const double bend = from.coupling[15 + at(i, j)][lane];
      system.coupling(e)(i, j) = -stretch;
      system.coupling(e)(3 + i, j) = -from.coupling[6 + 3 * i + j][lane];
      system.coupling(e)(3 + i, 3 + j) = -bend;
      system.diagonal(parent)(i, j) += stretch;
      system.diagonal(parent)(3 + i, 3 + j) += bend;
    }
  }
  // The parent's share of the element's energies.
  for (int i = 0; i < 6; ++i) system.right_side(parent)[i] += from.on_parent[i][lane];
}

void RowElimination::set_change(int plant, const BlockSystem& solved) {
  for (const int c : store_.layout.chains_of_plant(plant)) {
    const Chain& chain = store_.layout.chains()[c];
    for (const int e : chain.elements) {
      const Slot slot = store_.layout.slot(plant, e);
      // Times 0 where it came off: whatever springs and contacts added to its block must not move
      // it.
      const double alive = store_.element[slot.row].alive[slot.lane];
      for (int i = 0; i < 6; ++i)
        store_.scratch->factor[slot.row].right[i][slot.lane] = alive * solved.solution(e)[i];
    }
    // Its lane goes on where a longer chain stands beside it: nothing moves there.
    const int behind = store_.layout.slot(plant, chain.elements.back()).row + 1;
    for (int row = behind; row < store_.layout.end_row(chain.pack); ++row)
      for (Lanes& change : store_.scratch->factor[row].right) change[chain.lane] = 0.0;
  }
}

// The block system of a plant with loops has checked its own pivots.
bool RowElimination::healthy(int plant) const {
  return std::ranges::all_of(store_.layout.lanes_of_plant(plant), [&](const LaneRun& run) {
    // Only the lanes of this plant. A neighbour's bad pivot in the same pack is none of its
    // business, and must not stop it.
    const Lanes& healthy = store_.packs[run.pack].healthy;
    return store_.layout.keeps_blocks(run.pack) ||
           std::all_of(healthy + run.begin, healthy + run.end, [](double h) { return h > 0.0; });
  });
}

NewtonChange RowElimination::change(int plant) const {
  // Maxima over lanes that the kernels made on their way. Asking each element again would fetch all
  // rows once more.
  NewtonChange change;
  for (const auto [p, begin, end] : store_.layout.lanes_of_plant(plant)) {
    const Pack& pack = store_.packs[p];
    for (int lane = begin; lane < end; ++lane) {
      change.turn = std::max(change.turn, pack.turn[lane]);
      change.shift = std::max(change.shift, pack.shift[lane]);
      change.largest = std::max(change.largest, pack.change[lane]);
    }
  }
  return change;
}

Vec6 RowElimination::change(int plant, int element) const {
  const auto [row, lane] = store_.layout.slot(plant, element);
  Vec6 change;
  for (int i = 0; i < 6; ++i) change[i] = store_.scratch->factor[row].right[i][lane];
  return change;
}

// Where a step failed, the report names this element: there one looks first.
int RowElimination::largest_change(int plant, int elements) const {
  int worst = -1;
  double largest = 0.0;
  for (int e = 0; e < elements; ++e) {
    const double found = change(plant, e).cwiseAbs().maxCoeff();
    if (found <= largest) continue;
    largest = found;
    worst = e;
  }
  return worst;
}

}  // namespace pedicel::cosserat
