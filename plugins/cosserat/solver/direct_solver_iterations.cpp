// The part of DirectSolver that iterates: Newton, its contacts and its line search.
#include <algorithm>
#include <cmath>
#include <limits>

#include "pedicel/core/stop.h"
#include "pedicel/cosserat/solver/direct_solver.h"

namespace pedicel::cosserat {

namespace {

bool any(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), 1) != flags.end();
}

}  // namespace

// All plants take an iteration together, because their branches stand side by side in vectors. Each
// stops by itself; the others go on without it.
void DirectSolver::solve(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  std::fill(working_.begin(), working_.end(), 1);
  while (any(working_)) {
    rows_.store.set_active(working_);
    linearise_touched(steps, dt, pool);
    // The potential is computed in the same pass as the move where any plant is searched.
    bool measured = false;
    for (int p = 0; p < size(); ++p) {
      // Plants that are done share packs with those that are not. Their lanes are computed along,
      // and a share of 0 keeps them to the bit where they ended.
      rows_.search.set_share(p, working_[p] ? 1.0 : 0.0);
      iterates_[p] = working_[p] && plants_[p].touched ? &plants_[p].iterate : nullptr;
      measured =
          measured ||
          (working_[p] && plants_[p].control.is_searched(!plants_[p].contacts.only_with_itself()));
    }
    // Loops are solved between elimination and substitution. Without them a thread goes from one to
    // the other and to the move, while a pack's rows are in its cache.
    if (any_loops_) {
      rows_.elimination.eliminate(pool);
      pool.for_each(size(), [&](int p) {
        if (working_[p] && plants_[p].loops) solve_loops(p, *steps[p].model);
      });
      rows_.elimination.substitute(pool);
      rows_.search.move(pool, true, measured, iterates_);
    } else {
      rows_.search.solve_and_move(pool, measured, iterates_);
    }
    // Search first, then the contacts where it ended: validate_contacts() starts from the share
    // that the search took, and only shortens it.
    search(steps, measured, pool);
    validate_contacts(steps, dt, pool);
    for (int p = 0; p < size(); ++p) {
      if (!working_[p]) continue;
      Plant& plant = plants_[p];
      // Asked for every plant, although the stop flag alone would end it: is_done() counts the
      // iteration and sets the report.
      const bool done = plant.control.is_done(plant.pressing(), settings_, steps[p].report);
      if (done || (settling_ && stop_requested)) working_[p] = 0;  // settle() throws
    }
  }
}

// Contacts are found anew in every iteration, unless the search did so or they can be followed.
void DirectSolver::linearise_touched(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  const auto wanted = [&](int p) { return working_[p] && plants_[p].touched; };
  // The search has often written the iterate where it ended. Writing it twice would be a fetch of
  // all the plant's rows for nothing.
  for (int p = 0; p < size(); ++p)
    iterates_[p] = wanted(p) && !plants_[p].iterate_is_here ? &plants_[p].iterate : nullptr;
  if (std::any_of(iterates_.begin(), iterates_.end(), [](const RodState* s) { return s; }))
    rows_.states.write_iterate(pool, iterates_);
  for_each_plant(steps, pool, wanted, [&](int p) {
    Plant& plant = plants_[p];
    const RodModel& model = *steps[p].model;
    if (!plant.contacts_are_here && !follow_contacts(p, steps[p])) find_contacts(p, steps[p], dt);
    plant.contacts_are_here = false;
    // Loads and supports are few, and made anew in every iteration.
    plant.extras.clear();
    // Loads and contacts are not in the rows, so their share of the potential is kept beside it: a
    // line search that did not see them would climb into a contact.
    const double pressed = plant.contacts.energy();
    plant.presses = pressed > 0.0;
    plant.extra_energy = plant.attachments.linearise(model, plant.iterate, plant.extras) + pressed;
  });
  hand_over_blocks();
}

// To the rows, which point to the blocks. After contacts have been followed mostly the same
// elements have blocks in the same places, and the pointers hold.
void DirectSolver::hand_over_blocks() {
  bool any = false, stay = only_contacts_;
  only_contacts_ = true;
  const auto wanted = [&](int p) { return working_[p] && plants_[p].touched; };
  for (int p = 0; p < size(); ++p) {
    if (!wanted(p)) continue;
    any = true;
    only_contacts_ = only_contacts_ && plants_[p].extras.entries().empty();
    stay = stay && only_contacts_ && plants_[p].contacts.blocks_stay();
  }
  if (any && stay) return;
  // All are taken out, also those of plants that are done: a row keeps one chain of pointers for
  // all of its lanes, and one lane's cannot be cut out of it.
  rows_.elimination.clear_extras();
  for (int p = 0; p < size(); ++p) {
    if (!wanted(p) || plants_[p].loops) continue;
    // A plant with loops takes its blocks from solve_loops(). In the rows, too, they would count
    // twice.
    rows_.elimination.add_extras(p, plants_[p].extras.packed());
    rows_.elimination.add_extras(p, plants_[p].contacts.blocks());
  }
}

// At the iterate: normals, places and planes of all contacts, old ones and new.
void DirectSolver::find_contacts(int index, const PlantStep& step, double dt) {
  Plant& plant = plants_[index];
  // The step's start goes along, because friction measures its stretch from there.
  plant.contacts.find(*step.model, *step.state, plant.iterate, dt, step.contacts);
  plant.control.contacts_were_found();
}

// Where a plant touches only itself, a small way on it still touches where it did. Contacts with
// things outside are found again: their normals may turn at once, as at an edge.
bool DirectSolver::follow_contacts(int index, const PlantStep& step) {
  Plant& plant = plants_[index];
  // Asked first and in every iteration: the call adds up how far the plant went since contacts were
  // found.
  if (!plant.control.may_follow_contacts(settings_) ||
      !std::all_of(step.contacts.begin(), step.contacts.end(),
                   [](const ContactSource* s) { return s->is_within_plant(); }))
    return false;
  plant.contacts.follow(plant.iterate);
  return true;
}

// Welds and strands couple elements that are no neighbours in the tree: a block system solves the
// whole plant.
void DirectSolver::solve_loops(int index, const RodModel& model) {
  Plant& plant = plants_[index];
  BlockSystem& system = *plant.loops;
  // Rods come from the rows, so that welded plants keep the very equations of all others. Only the
  // solution is another one.
  rows_.elimination.copy_blocks(index, system);
  for (const DiagonalBlocks::Entry& entry : plant.extras.entries()) {
    system.diagonal(entry.element) += entry.diagonal;
    system.right_side(entry.element) += entry.right_side;
  }
  const ElementBlocks blocks = plant.contacts.blocks();
  for (std::size_t i = 0; i < blocks.elements.size(); ++i) {
    const int element = blocks.elements[i];
    if (element >= 0) blocks.values[i].add_to(system.diagonal(element), system.right_side(element));
  }
  // Only the block between the two elements. What a weld adds to their diagonal blocks is among the
  // extras already.
  for (int w = 0; w < static_cast<int>(model.welds.size()); ++w)
    system.weld(w) = weld_coupling(plant.iterate, model.welds[w]);
  for (int s = 0; s < static_cast<int>(model.strands.size()); ++s)
    system.strand(s) = strand_coupling(plant.iterate, model.strands[s]);
  // Without a solution the energy is no number, which ends the plant's step in start_search().
  if (system.solve())
    rows_.elimination.set_change(index, system);
  else
    plant.extra_energy = std::numeric_limits<double>::quiet_NaN();
}

// The whole of Newton's change has been made. So the first try of most plants is computed already;
// those that try less at once, and those that failed, move again.
void DirectSolver::search(std::span<PlantStep> steps, bool measured, ThreadPool& pool) {
  // All at once: other threads have made these numbers, and the loop below would wait for each of
  // them.
  rows_.search.fetch_results();
  for (int p = 0; p < size(); ++p)
    if (working_[p]) start_search(p, *steps[p].model, steps[p].report);
  // A plant may be searched that was not expected to be, because its last change was small.
  if (!measured && any(searching_)) {
    rows_.store.set_active(searching_);
    rows_.search.measure(pool);
  }
  for (bool first = true; any(searching_); first = false) {
    if (!first) {
      rows_.store.set_active(searching_);
      // The move starts again from where the iteration began, with the halved share. Halving from
      // the last try would add up rounding, and never come back to the start at a share of 0.
      rows_.search.move(pool, false, true, iterates_);
    }
    for_each_plant(
        steps, pool,
        [&](int p) { return searching_[p] && (!first || plants_[p].control.share() == 1.0); },
        [&](int p) { try_share(p, *steps[p].model, steps[p].report); });
  }
}

// A plant whose system has no solution stops here, and keeps the state that it began with.
void DirectSolver::start_search(int index, const RodModel& model, StepReport& report) {
  Plant& plant = plants_[index];
  const double energy = rows_.search.energy_before(index) + plant.extra_energy;
  // The Hessian is positive definite by design: a bad pivot is an overflow or a NaN.
  if (!rows_.elimination.healthy(index) || !std::isfinite(energy)) {
    report.errors |= not_finite;
    working_[index] = 0;
    iterates_[index] = nullptr;
    return;
  }
  // The energy before is where the Hessian was made. Compared with any later one the test would
  // allow a step that climbs from where it began.
  plant.control.begin_search(rows_.elimination.change(index), energy);
  const double share = plant.control.share();
  // The move made the whole change already. This share takes effect with the next move, and that is
  // why such plants skip the first round of search().
  if (share < 1.0) rows_.search.set_share(index, share);
  searching_[index] = plant.control.is_searched(!plant.contacts.only_with_itself());
  // The change is taken without a search. Whether contact presses still decides when to stop.
  if (searching_[index] || !plant.touched) return;
  plant.presses = plant.presses || plant.contacts.potential(model, plant.iterate) > 0.0;
  plant.iterate_is_here = true;
}

// A share of 0 is always accepted: then the iterate is where the search began.
void DirectSolver::try_share(int index, const RodModel& model, StepReport& report) {
  Plant& plant = plants_[index];
  // The potential of rods and inertia comes from the rows, that of loads and contacts from the
  // state.
  double found = rows_.search.energy(index);
  if (plant.touched) {
    plant.pressed = plant.contacts.potential(model, plant.iterate);
    plant.presses = plant.presses || plant.pressed > 0.0;
    found += plant.attachments.potential(model, plant.iterate) + plant.pressed;
  }
  if (plant.control.accepts(found)) {
    searching_[index] = 0;
    plant.iterate_is_here = plant.touched;
    return;
  }
  // At the share 0 the loop goes round once more: the rows have to be moved back, and accepts()
  // then ends it.
  if (!plant.control.halve_share()) report.errors |= line_search_failed;
  rows_.search.set_share(index, plant.control.share());
}

// A move by many radii may end deep in what it was not near before, which the search did not feel:
// the next iteration would find energy there that nothing has put in. So contacts are found again
// at its end, and it is cut until the potential with them has not risen by more than the known ones
// hold. At the share 0 it has not risen.
void DirectSolver::validate_contacts(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  for (int p = 0; p < size(); ++p) {
    searching_[p] =
        working_[p] && !steps[p].contacts.empty() && plants_[p].control.must_find_contacts_again();
  }
  while (any(searching_)) {
    bool cut = false;
    for (int p = 0; p < size(); ++p) {
      if (!searching_[p]) continue;
      Plant& plant = plants_[p];
      const RodModel& model = *steps[p].model;
      // One plant after the other, each with all threads.
      lend(&pool, p, steps[p]);
      find_contacts(p, steps[p], dt);
      plant.contacts_are_here = true;
      const double found = rows_.search.energy(p) +
                           plant.attachments.potential(model, plant.iterate) +
                           plant.contacts.potential(model, plant.iterate);
      lend(nullptr, p, steps[p]);
      searching_[p] = !plant.control.accepts_new_contacts(found, plant.pressed);
      if (!searching_[p]) continue;
      plant.control.halve_share();
      rows_.search.set_share(p, plant.control.share());
      cut = true;
    }
    if (!cut) break;
    rows_.store.set_active(searching_);
    rows_.search.move(pool, false, true, iterates_);
  }
}

}  // namespace pedicel::cosserat
