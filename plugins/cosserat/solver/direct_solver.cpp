#include "plugins/cosserat/solver/direct_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/stop.h"
#include "plugins/cosserat/model/rotation.h"

namespace pedicel::cosserat {

namespace {

// Makes `iterate` what it will be but for where the elements are, which the rows write. It has no
// velocities.
// The vectors keep their memory from step to step: resize() allocates in the first step only.
void follow(const RodState& state, RodState& iterate) {
  iterate.position.resize(state.position.size());
  iterate.orientation.resize(state.orientation.size());
  iterate.alive = state.alive;
  iterate.fruit_gone = state.fruit_gone;
  iterate.root = state.root;
  iterate.previous_root = state.previous_root;
  iterate.time = state.time;
}

// The k-th of so many equal parts of its way.
Clamp part_of(const Clamp& whole, int k, int parts) {
  const auto at = [&](int i) {
    // The last part ends exactly where the whole does. Interpolated at 1 it would be off by
    // rounding, and the next step would begin from another clamp than the scene set.
    return i == parts ? whole.now : between(whole.before, whole.now, i / double(parts));
  };
  return {whole.first_element, at(k), at(k + 1)};
}

bool any(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), 1) != flags.end();
}

}  // namespace

DirectSolver::Plant::Plant(const RodModel& model, bool by_blocks)
    : attachments(by_blocks), extras(model.size()) {
  if (by_blocks) loops = std::make_unique<BlockSystem>(model);
}

Pressing DirectSolver::Plant::pressing() const {
  if (!presses) return Pressing::nothing;
  return contacts.only_with_itself() ? Pressing::itself : Pressing::outside;
}

DirectSolver::DirectSolver(const RodSettings& settings, const RodModel& model)
    : DirectSolver(settings, std::array{&model}, 1) {}

DirectSolver::DirectSolver(const RodSettings& settings, std::span<const RodModel* const> models,
                           int threads, std::shared_ptr<RowScratch> scratch)
    : settings_(settings), rows_(models, threads, false, std::move(scratch)) {
  // All that a step needs is made here: step() must not allocate.
  plants_.reserve(models.size());
  for (const RodModel* model : models) {
    const int index = static_cast<int>(plants_.size());
    plants_.emplace_back(*model, rows_.store.layout.plant_keeps_blocks(index));
    // One plant whose loops are not in lanes makes all take the road that waits between elimination
    // and substitution.
    any_loops_ = any_loops_ || plants_.back().loops;
  }
  states_.resize(plants_.size());
  iterates_.resize(plants_.size());
  working_.resize(plants_.size());
  unchanged_.resize(plants_.size());
  searching_.resize(plants_.size());
}

// Without history the next step is of first order, which needs no past.
void DirectSolver::reset(int plant) {
  // Friction's springs go, too. They are stretches against a surface that the new state never
  // touched, and would pull the plant towards a place that it was not at.
  plants_[plant].contacts.forget();
  plants_[plant].has_history = false;
  plants_[plant].control.reset();
}

StepReport DirectSolver::step(const RodModel& model, RodState& state, const StepInput& input) {
  PlantStep one{&model, &state, input.loads, input.contacts, true, true, {}};
  step({&one, 1}, input.dt, input.gravity);
  return one.report;
}

void DirectSolver::step(std::span<PlantStep> steps, double dt, const Vec3& gravity,
                        ThreadPool& pool) {
  // The order of events in a step is: read, guess, solve, take again in substeps, write. Everything
  // before end() works on copies in the rows, and the states of the caller stand still.
  begin(steps, dt, gravity, pool);
  solve(steps, dt, pool);
  // No state has been written yet, so that a step can be taken again from where it began. Substeps
  // are not cut a second time: what two do not solve is reported as not converged.
  for (int p = 0; p < size() && !is_substepper_; ++p) {
    if (IterationControl::needs_substeps(plants_[p].pressing(), steps[p].report))
      take_in_substeps(p, steps[p], dt, gravity);
    else
      plants_[p].control.count_whole();
  }
  end(steps, dt, pool);
}

// Contact is the work of one thread, unless a single plant has all of them to itself.
void DirectSolver::lend(ThreadPool* pool, int index, const PlantStep& step) {
  // Sources search with the same threads as the terms. With several plants at work these take the
  // threads already, one each, and nobody is lent the pool.
  plants_[index].contacts.use(pool);
  for (ContactSource* source : step.contacts) source->use(pool);
}

// What a step starts from: the model and the state in rows, the scheme, the laws and what touches.
void DirectSolver::begin(std::span<PlantStep> steps, double dt, const Vec3& gravity,
                         ThreadPool& pool) {
  rows_.store.gravity = gravity;
  for (int p = 0; p < size(); ++p) {
    Plant& plant = plants_[p];
    PlantStep& step = steps[p];
    step.report = {};
    states_[p] = step.state;
    // Where nobody touched the state since the last step, the rows still hold it.
    unchanged_[p] = plant.stands_in_rows && !step.state_changed;
    if (step.model_changed) rows_.states.read_model(p, *step.model);
    // BDF2 needs one step of the past, of about the same length.
    const double before = step.state->previous_dt;
    const bool first_order = settings_.integrator == Integrator::backward_euler ||
                             !plant.has_history ||
                             !IterationControl::suits_second_order(dt, before);
    // Must outlive the span below, which only points to it.
    const Clamp root = own_clamp(*step.state);
    rows_.states.set_scheme(p, dt, first_order ? 0.0 : before,
                            step.clamps.empty() ? std::span(&root, 1) : step.clamps,
                            plant.control.continues_acceleration());
    // Drift and gusts are functions of the time at the step's end, which is made from `time` and
    // dt: the state's own time is raised in end() only.
    rows_.extensions.begin_step(p, *step.model, step.state->time, dt, settling_, step.air);
    begin_memory(p, *step.model, *step.state);
    // What touches a plant looks at its iterate as a state. All others are solved in rows alone.
    plant.touched = !step.loads.empty() || !step.contacts.empty() || !step.ties.empty() ||
                    !step.model->supports.empty() || plant.loops;
    plant.extra_energy = 0.0;
    plant.presses = false;
    plant.substepped = false;
    plant.iterate_is_here = plant.contacts_are_here = false;
    plant.control.begin_step();
  }
  // All plants are active for the guess. The iteration takes them out one by one.
  std::fill(working_.begin(), working_.end(), 1);
  rows_.store.set_active(working_);
  rows_.states.prepare(pool, states_, unchanged_);
  for_each_plant(
      steps, pool, [&](int p) { return plants_[p].touched; },
      [&](int p) {
        // Sources begin their step on the state and not on the guess: what they measure of motion,
        // such as the way that friction has been dragged, is from where the plant stood.
        follow(*steps[p].state, plants_[p].iterate);
        plants_[p].attachments.prepare(*steps[p].state, steps[p].loads, steps[p].ties);
        for (ContactSource* source : steps[p].contacts)
          source->begin_step(*steps[p].model, *steps[p].state, dt);
      });
  choose_start(steps, pool);
}

// A state that comes without memory starts it here.
void DirectSolver::begin_memory(int index, const RodModel& model, RodState& state) const {
  if (model.laws.empty()) return;
  const std::size_t joints = model.laws.size();
  // Both sizes are compared: a state that was saved under other laws has a memory of another
  // length, and its entries would be taken for those of other branches.
  if (state.joint_bias.size() == joints &&
      state.joint_memory.size() == joints * rows_.extensions.branches(index))
    return;
  state.joint_bias.clear();
  start_memory(model, state);
}

// Newton starts from the motion continued, so that one iteration is second order in time too; or
// from where the step starts if the potential is lower there: what turns fast cannot be continued
// along straight lines, and few iterations would leave the strain of that in the rods as energy.
void DirectSolver::choose_start(std::span<PlantStep> steps, ThreadPool& pool) {
  // The list is free until the line search, and step() must not allocate another one.
  std::vector<char>& fast = searching_;
  for (int p = 0; p < size(); ++p) fast[p] = IterationControl::is_fast(rows_.elimination.change(p));
  if (std::ranges::find(fast, 1) == fast.end()) return;
  rows_.store.set_active(fast);
  for (int p = 0; p < size(); ++p) {
    Plant& plant = plants_[p];
    iterates_[p] = fast[p] && plant.touched ? &plant.iterate : nullptr;
  }
  // Contacts are not known at either of the two yet, and do not count.
  rows_.search.compare_start(pool, iterates_);
  for (int p = 0; p < size(); ++p) {
    if (!fast[p]) continue;
    Plant& plant = plants_[p];
    // Supports, ties and loads count beside the rods. A clamp or a tie that moved leaves the step's
    // start with all of the stretch, and then the guess is the better start although the rods
    // prefer none.
    const auto attached = [&](const RodState& state) {
      return plant.touched ? plant.attachments.potential(*steps[p].model, state) : 0.0;
    };
    plant.iterate_is_here = rows_.search.energy(p) + attached(plant.iterate) <
                            rows_.search.energy_before(p) + attached(*steps[p].state);
    if (!plant.iterate_is_here) rows_.states.hold(p);
    fast[p] = 0;
  }
}

// A stem that is dragged over an edge slides by many of its radii in one step, too far for Newton;
// cut short, it may end on the other side of a thin link. In a substep what drags it moves less.
void DirectSolver::take_in_substeps(int index, PlantStep& step, double dt, const Vec3& gravity) {
  Plant& plant = plants_[index];
  if (!plant.substepper) plant.substepper = std::make_unique<DirectSolver>(settings_, *step.model);
  // It has rows of its own. Taken in these rows, a substep of one plant would overwrite the step of
  // its neighbours, which stand in the same packs and are not written out yet.
  DirectSolver& solver = *plant.substepper;
  Plant& alone = solver.plants_.front();
  solver.settings_ = settings_;
  solver.is_substepper_ = true;
  // A substep is not as long as what the substepper did last, so that has no history for it.
  solver.reset();
  solver.forces_.clear();
  plant.control.count_substepped();
  alone.control.begin_substeps(plant.control);
  // The contacts go along, for what friction remembers of the step before.
  std::swap(alone.contacts, plant.contacts);
  RodState& state = *step.state;
  // Kept to put the state back where a substep fails. The iterate is not needed any more: this
  // plant's step in the rows is given up.
  plant.iterate = state;
  constexpr int substeps = IterationControl::substeps;
  // What moves the plant, its clamp and what touches it, does an equal share in each substep.
  const Pose from = state.previous_root, to = state.root;
  std::vector<Clamp> clamps(step.clamps.begin(), step.clamps.end());
  step.report = {};
  for (int k = 0; k < substeps; ++k) {
    // Colliders stand at their end-of-step poses. Without this the first substep would meet the
    // whole motion, and nothing would be gained.
    for (ContactSource* source : step.contacts)
      source->cover(k / double(substeps), (k + 1) / double(substeps));
    state.root = k + 1 == substeps ? to : between(from, to, (k + 1) / double(substeps));
    for (std::size_t i = 0; i < clamps.size(); ++i)
      clamps[i] = part_of(step.clamps[i], k, substeps);
    // From the second substep on the rows of the substepper hold the state that it wrote itself.
    // `clamps` is empty for a plant of one tree, whose clamp is then read from `root` as set above.
    PlantStep part{step.model, step.state, step.loads, step.contacts, k == 0,
                   k == 0,     {},         clamps,     step.ties,     step.air};
    solver.step({&part, 1}, dt / substeps, gravity);
    // The step is as good as its worst substep.
    part.report.errors |= step.report.errors;
    part.report.iterations += step.report.iterations;
    if (part.report.element < 0) part.report.element = step.report.element;
    step.report = part.report;
    // Both substeps or none, as a step that fails without substeps leaves its state as it was.
    if (part.report.errors & not_finite) {
      state = plant.iterate;
      break;
    }
    // Forces are means over the step.
    // Impulses are what must be right: a robot gets force times dt of the whole step.
    alone.contacts.add_to(solver.forces_, 1.0 / substeps);
  }
  for (ContactSource* source : step.contacts) source->cover(0.0, 1.0);
  std::swap(alone.contacts, plant.contacts);
  plant.contacts.report(solver.forces_);
  plant.substepped = true;
  // end() adds the whole step, as it does for others.
  state.time = plant.iterate.time;
}

// Positions and velocities are written here only: a step that failed leaves them as they were.
void DirectSolver::end(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  for (int p = 0; p < size(); ++p)  // what substeps leave is not in the rows
    if (plants_[p].substepped || (steps[p].report.errors & not_finite)) states_[p] = nullptr;
  rows_.states.finish(pool, states_);
  const auto all = [](int) { return true; };
  for_each_plant(steps, pool, all, [&](int p) {
    Plant& plant = plants_[p];
    RodState& state = *steps[p].state;
    StepReport& report = steps[p].report;
    // The past in the rows is that of a whole step. After substeps it is of another plant position
    // and another length, so BDF2 would differentiate across the gap.
    plant.has_history = !plant.substepped;
    // What came off is not written any more, so that rows and state differ: it is read again.
    plant.stands_in_rows = states_[p] && std::ranges::find(state.alive, 0) == state.alive.end();
    state.previous_root = state.root;
    // What failed is not to be continued: the next step is of first order.
    if (report.errors & not_finite) {
      state.previous_dt = 0.0;
      return;
    }
    if (plant.substepped) {
      state.previous_dt = 0.0;
      state.time += dt;
      return;
    }
    // Finding the element takes all changes of a plant, so only where somebody will ask for it.
    // Before end_step(): the changes stand in scratch that is reused from there on.
    if (report.errors != none) report.element = rows_.elimination.largest_change(p, state.size());
    plant.contacts.finish(*steps[p].model, state);
    report.contacts = plant.contacts.carrying();
    report.deepest = plant.contacts.deepest();
    // A next step of first order damps what a rough one left.
    const bool converged = !(report.errors & not_converged);
    state.previous_dt = plant.control.ends_roughly(plant.pressing(), converged) ? 0.0 : dt;
    state.time += dt;
  });
  // Last of all: it swaps the rows, and everything above still reads the step by its old names.
  rows_.states.end_step();
}

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
