#include "plugins/cosserat/solver/row_search.h"

#include <algorithm>

#include "plugins/cosserat/lanes/lane_kernels.h"

namespace pedicel::cosserat {

// Nothing needs the clamps of the start any more: prepare() has taken the strains against them.
void RowSearch::compare_start(ThreadPool& pool, std::span<RodState* const> states) {
  const RowArrays at_guess = store_.arrays();
  RowArrays at_start = at_guess;
  at_start.iterate = at_start.start;
  store_.each_pack(pool, [&](int p) {
    Pack& pack = store_.packs[p];
    if (!pack.active) return;
    store_.place_anchors(p, store_.scratch->start);
    store_.take_anchors(p);
    evaluate(at_start, pack, pack.energy_before);
    evaluate(at_guess, pack, pack.energy);
    states_.write_pack(p, states);
  });
}

void RowSearch::set_share(int plant, double share) {
  if (share == shares_[plant]) return;
  shares_[plant] = share;
  for (const auto [p, begin, end] : store_.layout.lanes_of_plant(plant))
    std::fill(store_.packs[p].share + begin, store_.packs[p].share + end, share);
}

void RowSearch::move(ThreadPool& pool, bool keep, bool measured,
                     std::span<RodState* const> states) {
  const RowArrays rows = store_.arrays();
  store_.graph.pre_order(pool, [&](int task) { move_task(rows, task, keep, measured, states); });
}

// The last row of a pack that is eliminated from the clamp is a task of its own: what starts there
// can then move before the pack does.
void RowSearch::move_task(const RowArrays& rows, int task, bool keep, bool measured,
                          std::span<RodState* const> states) {
  const int number = store_.layout.pack_of(task);
  Pack& pack = store_.packs[number];
  if (!pack.active) return;
  const bool is_pack = store_.layout.is_pack(task), whole = !store_.layout.from_clamp(number);
  const int last = pack.end - 1;
  cosserat::move(rows, pack, is_pack ? pack.begin + 1 : last, is_pack && !whole ? last : pack.end,
                 keep, measured && whole);
  store_.pass_on_poses(task);
  if (!is_pack) return;
  if (measured && !whole) evaluate(rows, pack, pack.energy);
  states_.write_pack(task, states);
}

void RowSearch::measure(ThreadPool& pool) {
  const RowArrays rows = store_.arrays();
  store_.each_pack(pool, [&](int p) {
    if (store_.packs[p].active) evaluate(rows, store_.packs[p], store_.packs[p].energy);
  });
}

void RowSearch::solve_and_move(ThreadPool& pool, bool measured, std::span<RodState* const> states) {
  const RowArrays rows = elimination_.arrays();
  store_.graph.post_and_pre_order(
      pool, [&](int task) { elimination_.eliminate_task(rows, task); },
      [&](int task) {
        elimination_.substitute_task(rows, task);
        move_task(rows, task, true, measured, states);
      });
}

// From the caches of the cores that computed them.
void RowSearch::fetch_results() const {
  for (const Pack& pack : store_.packs)
    for (const auto* result :
         {&pack.energy_before, &pack.energy, &pack.turn, &pack.shift, &pack.change, &pack.healthy})
      __builtin_prefetch(result);
}

double RowSearch::sum(int plant, const Lanes Pack::*energy) const {
  double sum = 0.0;
  for (const auto [p, begin, end] : store_.layout.lanes_of_plant(plant))
    for (int lane = begin; lane < end; ++lane) sum += (store_.packs[p].*energy)[lane];
  return sum;
}

}  // namespace pedicel::cosserat
