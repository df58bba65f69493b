#include "pedicel/cosserat/solver/row_elimination.h"

#include <algorithm>

#include "pedicel/cosserat/lanes/lane_kernels.h"

namespace pedicel::cosserat {

namespace {

constexpr int at(int i, int j) {  // in a lower triangle by rows
  return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
}

}  // namespace

RowArrays RowElimination::arrays() {
  RowArrays rows = store_.arrays();
  rows.first_extra = first_extra_.data();
  rows.extras = extras_.data();
  return rows;
}

void RowElimination::add_extras(int plant, const ElementBlocks& blocks) {
  for (std::size_t i = 0; i < blocks.elements.size(); ++i) {
    if (blocks.elements[i] < 0) continue;
    const Slot slot = store_.layout.slot(plant, blocks.elements[i]);
    extras_.push_back({blocks.values[i].values.data(), 1, slot.lane, first_extra_[slot.row]});
    first_extra_[slot.row] = static_cast<int>(extras_.size()) - 1;
    extra_rows_.push_back(slot.row);
  }
}

// Only the rows that have any: they are few.
void RowElimination::clear_extras() {
  for (const int row : extra_rows_) first_extra_[row] = -1;
  extra_rows_.clear();
  extras_.clear();
}

void RowElimination::eliminate(ThreadPool& pool) {
  const RowArrays rows = arrays();
  store_.graph.post_order(pool, [&](int task) { eliminate_task(rows, task); });
}

void RowElimination::eliminate_task(const RowArrays& rows, int task) {
  const LaneLayout& layout = store_.layout;
  const int number = layout.pack_of(task);
  Pack& pack = store_.packs[number];
  if (!pack.active) return;
  for (const int branch : store_.graph.needs(task))  // perhaps in another core's cache
    for (const Lanes& values : store_.packs[branch].branch) __builtin_prefetch(values);
  if (!layout.is_pack(task)) {
    solve_last(rows, pack);
    return;
  }
  if (!pack.anchored) store_.take_anchors(number);
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
  store_.pass_on_changes(task);
}

void RowElimination::copy_blocks(int plant, BlockSystem& system) const {
  system.clear();
  for (const int c : store_.layout.chains_of_plant(plant)) {
    const Chain& chain = store_.layout.chains()[c];
    int parent = store_.anchors[chain.pack][chain.lane].element;
    for (const int e : chain.elements) {
      const int row = store_.layout.slot(plant, e).row;
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
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) system.diagonal(e)(i, j) += from.diagonal[at(i, j)][lane];
    system.right_side(e)[i] += from.right[i][lane];
  }
  if (parent < 0) return;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
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
    const Lanes& healthy = store_.packs[run.pack].healthy;
    return store_.layout.keeps_blocks(run.pack) ||
           std::all_of(healthy + run.begin, healthy + run.end, [](double h) { return h > 0.0; });
  });
}

NewtonChange RowElimination::change(int plant) const {
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
