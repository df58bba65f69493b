#include "pedicel/cosserat/solver/direct_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pedicel/core/stop.h"
#include "pedicel/cosserat/model/rotation.h"

namespace pedicel::cosserat {

namespace {

constexpr double largest_turn =
    1.0;  // rad, of one Newton step: beyond it the quadratic model is void
constexpr double converged_change = 1.0e-3;  // m or rad
constexpr double rough_change = 0.3;         // rad, or element lengths
constexpr double looked_after = 0.1;         // likewise
constexpr double rough_unsolved = 0.1;       // likewise
constexpr double straight_turn = 0.03;       // rad
constexpr double unsearched_change = 0.03;   // rad, or element lengths
constexpr double largest_ratio = 2.0;        // of two steps' lengths for BDF2 (stable below 2.41)
constexpr double smallest_share = 1.0 / 4096.0;
constexpr int rough_contact_iterations = 4;  // times newton_iterations
constexpr int parts = 2;                     // of a step that contact keeps from its solution
// Of parts of steps in which Newton goes to and fro:
constexpr int most_knocks = 10;  // steps in a row that are taken in parts before it is damped
constexpr double cycling_gain = 0.95;
constexpr double most_damped = 1.0 / 16.0;
constexpr int damped_iterations = 2;  // times as many
// Of a plant's contact with itself:
constexpr double rough_self_contact = 10.0;  // times the tolerance
constexpr double stalled_gain = 0.9;         // more iterations do not help
constexpr double left_over = 0.6;            // times the tolerance: of what is left by the series
constexpr double left_over_ahead = 0.2;      // likewise, by the gain of an earlier step
constexpr double followed_self_contact = 20.0;  // times the tolerance

// Makes `iterate` what it will be but for where the elements are, which the rows write. It has no
// velocities.
void follow(const RodState& state, RodState& iterate) {
  iterate.position.resize(state.position.size());
  iterate.orientation.resize(state.orientation.size());
  iterate.alive = state.alive;
  iterate.fruit_gone = state.fruit_gone;
  iterate.root = state.root;
  iterate.previous_root = state.previous_root;
  iterate.time = state.time;
}

// The gain of a step that did not measure it.
double trusted_less(double gain) {
  return std::pow(gain, 0.8);
}

bool any(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), 1) != flags.end();
}

}  // namespace

DirectSolver::Plant::Plant(const RodModel& model) : extras(model.size()) {
  if (!model.welds.empty()) loops = std::make_unique<BlockSystem>(model);
}

DirectSolver::DirectSolver(const RodSettings& settings, const RodModel& model)
    : DirectSolver(settings, std::array{&model}, 1) {}

DirectSolver::DirectSolver(const RodSettings& settings, std::span<const RodModel* const> models,
                           int threads, std::shared_ptr<RowScratch> scratch)
    : settings_(settings), rows_(models, threads, false, std::move(scratch)) {
  plants_.reserve(models.size());
  for (const RodModel* model : models) {
    plants_.emplace_back(*model);
    any_loops_ = any_loops_ || plants_.back().loops;
  }
  states_.resize(plants_.size());
  iterates_.resize(plants_.size());
  working_.resize(plants_.size());
  unchanged_.resize(plants_.size());
  searching_.resize(plants_.size());
}

void DirectSolver::reset(int plant) {
  plants_[plant].contacts.forget();
  plants_[plant].has_history = false;
  plants_[plant].smooth = false;
  plants_[plant].gain = 1.0;
  plants_[plant].stuck_for = 0;
}

StepReport DirectSolver::step(const RodModel& model, RodState& state, const StepInput& input) {
  PlantStep one{&model, &state, input.loads, input.contacts, true, true, {}};
  step({&one, 1}, input.dt, input.gravity);
  return one.report;
}

void DirectSolver::step(std::span<PlantStep> steps, double dt, const Vec3& gravity,
                        ThreadPool& pool) {
  begin(steps, dt, gravity, pool);
  solve(steps, dt, pool);
  const auto is_stuck = [&](int p) {
    const Plant& plant = plants_[p];
    return (steps[p].report.errors & not_converged) && plant.presses &&
           !plant.contacts.only_with_itself();
  };
  for (int p = 0; p < size() && !is_part_; ++p) {
    if (is_stuck(p))
      take_in_parts(p, steps[p], dt, gravity);
    else
      plants_[p].stuck_for = 0;
  }
  end(steps, dt, pool);
}

// task(p) for the plants that are wanted. A single one may use the threads for itself, with the
// sources that touch it.
template <class Wanted, class Task>
void DirectSolver::for_each_plant(std::span<PlantStep> steps, ThreadPool& pool,
                                  const Wanted& wanted, const Task& task) {
  int count = 0, last = 0;
  for (int p = 0; p < size(); ++p) {
    if (!wanted(p)) continue;
    ++count;
    last = p;
  }
  if (count > 1) {
    pool.for_each(size(), [&](int p) {
      if (wanted(p)) task(p);
    });
  } else if (count == 1) {
    lend(&pool, last, steps[last]);
    task(last);
    lend(nullptr, last, steps[last]);
  }
}

void DirectSolver::lend(ThreadPool* pool, int index, const PlantStep& step) {
  plants_[index].contacts.use(pool);
  for (ContactSource* source : step.contacts) source->use(pool);
}

void DirectSolver::begin(std::span<PlantStep> steps, double dt, const Vec3& gravity,
                         ThreadPool& pool) {
  rows_.set_gravity(gravity);
  for (int p = 0; p < size(); ++p) {
    Plant& plant = plants_[p];
    PlantStep& step = steps[p];
    step.report = {};
    states_[p] = step.state;
    unchanged_[p] = plant.stands_in_rows && !step.state_changed;
    if (step.model_changed) rows_.read_model(p, *step.model);
    const double before = step.state->previous_dt;
    const bool first_order = settings_.integrator == Integrator::backward_euler ||
                             !plant.has_history ||
                             std::max(dt, before) > largest_ratio * std::min(dt, before);
    rows_.set_scheme(p, dt, first_order ? 0.0 : before, step.state->root, plant.smooth);
    plant.smooth = false;
    rows_.set_extensions(p, *step.model, step.state->time, dt, settling_);
    begin_memory(p, *step.model, *step.state);
    plant.touched = !step.loads.empty() || !step.contacts.empty() ||
                    !step.model->supports.empty() || plant.loops;
    plant.extra_energy = 0.0;
    plant.last_change = 0.0;
    plant.presses = false;
    plant.in_parts = false;
    plant.damped = 1.0;
    plant.iterate_is_here = plant.contacts_are_here = false;
    plant.followed = std::numeric_limits<double>::infinity();
  }
  std::fill(working_.begin(), working_.end(), 1);
  rows_.set_active(working_);
  rows_.prepare(pool, states_, unchanged_);
  for_each_plant(
      steps, pool, [&](int p) { return plants_[p].touched; },
      [&](int p) {
        follow(*steps[p].state, plants_[p].iterate);
        plants_[p].attachments.prepare(*steps[p].state, steps[p].loads);
        for (ContactSource* source : steps[p].contacts)
          source->begin_step(*steps[p].model, *steps[p].state, dt);
      });
  choose_start(steps, pool);
}

// A state that comes without memory starts it here.
void DirectSolver::begin_memory(int index, const RodModel& model, RodState& state) const {
  if (model.laws.empty()) return;
  const std::size_t joints = model.laws.size();
  if (state.joint_bias.size() == joints &&
      state.joint_memory.size() == joints * rows_.branches(index))
    return;
  state.joint_bias.clear();
  start_memory(model, state);
}

// Newton starts from the motion continued, so that one iteration is second order in time too; or
// from where the step starts if the potential is lower there: what turns fast cannot be continued
// along straight lines, and few iterations would leave the strain of that in the rods as energy.
void DirectSolver::choose_start(std::span<PlantStep> steps, ThreadPool& pool) {
  std::vector<char>& fast = searching_;
  for (int p = 0; p < size(); ++p) fast[p] = rows_.change(p).turn > straight_turn;
  if (!any(fast)) return;
  rows_.set_active(fast);
  for (int p = 0; p < size(); ++p) {
    Plant& plant = plants_[p];
    iterates_[p] = fast[p] && plant.touched ? &plant.iterate : nullptr;
  }
  rows_.compare_start(pool, iterates_);
  for (int p = 0; p < size(); ++p) {
    if (!fast[p]) continue;
    Plant& plant = plants_[p];
    const auto attached = [&](const RodState& state) {
      return plant.touched ? plant.attachments.potential(*steps[p].model, state) : 0.0;
    };
    plant.iterate_is_here = rows_.energy(p) + attached(plant.iterate) <
                            rows_.energy_before(p) + attached(*steps[p].state);
    if (!plant.iterate_is_here) rows_.hold(p);
    fast[p] = 0;
  }
}

void DirectSolver::solve(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  std::fill(working_.begin(), working_.end(), 1);
  while (any(working_)) {
    rows_.set_active(working_);
    linearise_touched(steps, dt, pool);
    bool measured = false;
    for (int p = 0; p < size(); ++p) {
      rows_.set_share(p, working_[p] ? 1.0 : 0.0);
      iterates_[p] = working_[p] && plants_[p].touched ? &plants_[p].iterate : nullptr;
      measured = measured || (working_[p] && plants_[p].is_searched());
    }
    if (any_loops_) {
      rows_.eliminate(pool);
      pool.for_each(size(), [&](int p) {
        if (working_[p] && plants_[p].loops) solve_loops(p, *steps[p].model);
      });
      rows_.substitute(pool);
      rows_.move(pool, true, measured, iterates_);
    } else {
      rows_.solve_and_move(pool, measured, iterates_);
    }
    search(steps, measured, pool);
    look_again(steps, dt, pool);
    for (int p = 0; p < size(); ++p)
      if (working_[p] && is_done(plants_[p], steps[p].report)) working_[p] = 0;
  }
}

// Contacts are found anew in every iteration, unless the search did so or they can be followed.
void DirectSolver::linearise_touched(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  const auto wanted = [&](int p) { return working_[p] && plants_[p].touched; };
  for (int p = 0; p < size(); ++p)
    iterates_[p] = wanted(p) && !plants_[p].iterate_is_here ? &plants_[p].iterate : nullptr;
  if (std::any_of(iterates_.begin(), iterates_.end(), [](const RodState* s) { return s; }))
    rows_.write_iterate(pool, iterates_);
  for_each_plant(steps, pool, wanted, [&](int p) {
    Plant& plant = plants_[p];
    const RodModel& model = *steps[p].model;
    if (!plant.contacts_are_here && !follow_contacts(p, steps[p])) find_contacts(p, steps[p], dt);
    plant.contacts_are_here = false;
    plant.extras.clear();
    const double pressed = plant.contacts.energy();
    plant.presses = pressed > 0.0;
    plant.extra_energy = plant.attachments.linearise(model, plant.iterate, plant.extras) + pressed;
  });
  hand_over_blocks();
}

// To the rows, which may have the same ones already.
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
  rows_.clear_extras();
  for (int p = 0; p < size(); ++p) {
    if (!wanted(p) || plants_[p].loops) continue;
    rows_.add_extras(p, plants_[p].extras.packed());
    rows_.add_extras(p, plants_[p].contacts.blocks());
  }
}

void DirectSolver::find_contacts(int index, const PlantStep& step, double dt) {
  Plant& plant = plants_[index];
  plant.contacts.find(*step.model, *step.state, plant.iterate, dt, step.contacts);
  plant.followed = 0.0;
}

// Where a plant touches only itself, a small way on it still touches where it did.
bool DirectSolver::follow_contacts(int index, const PlantStep& step) {
  Plant& plant = plants_[index];
  plant.followed += plant.share * std::max(plant.change.turn, plant.change.shift);
  const bool is_near = plant.followed <= followed_self_contact * settings_.self_contact_tolerance;
  if (!is_near || !std::all_of(step.contacts.begin(), step.contacts.end(),
                               [](const ContactSource* s) { return s->is_within_plant(); }))
    return false;
  plant.contacts.follow(plant.iterate);
  return true;
}

void DirectSolver::solve_loops(int index, const RodModel& model) {
  Plant& plant = plants_[index];
  BlockSystem& system = *plant.loops;
  rows_.copy_blocks(index, system);
  for (const DiagonalBlocks::Entry& entry : plant.extras.entries()) {
    system.diagonal(entry.element) += entry.diagonal;
    system.right_side(entry.element) += entry.right_side;
  }
  const ElementBlocks blocks = plant.contacts.blocks();
  for (std::size_t i = 0; i < blocks.elements.size(); ++i) {
    const int element = blocks.elements[i];
    if (element >= 0) blocks.values[i].add_to(system.diagonal(element), system.right_side(element));
  }
  for (int w = 0; w < static_cast<int>(model.welds.size()); ++w)
    system.weld(w) = weld_coupling(plant.iterate, model.welds[w]);
  if (system.solve())
    rows_.set_change(index, system);
  else
    plant.extra_energy = std::numeric_limits<double>::quiet_NaN();
}

// The whole of Newton's change has been made.
void DirectSolver::search(std::span<PlantStep> steps, bool measured, ThreadPool& pool) {
  rows_.fetch_results();
  for (int p = 0; p < size(); ++p)
    if (working_[p]) start_search(p, *steps[p].model, steps[p].report);
  if (!measured && any(searching_)) {
    rows_.set_active(searching_);
    rows_.measure(pool);
  }
  for (bool first = true; any(searching_); first = false) {
    if (!first) {
      rows_.set_active(searching_);
      rows_.move(pool, false, true, iterates_);
    }
    for_each_plant(
        steps, pool, [&](int p) { return searching_[p] && (!first || plants_[p].share == 1.0); },
        [&](int p) { try_share(p, *steps[p].model, steps[p].report); });
  }
}

void DirectSolver::start_search(int index, const RodModel& model, StepReport& report) {
  Plant& plant = plants_[index];
  plant.energy = rows_.energy_before(index) + plant.extra_energy;
  if (!rows_.healthy(index) || !std::isfinite(plant.energy)) {
    report.errors |= not_finite;
    working_[index] = 0;
    iterates_[index] = nullptr;
    return;
  }
  plant.change = rows_.change(index);
  plant.share = std::min(plant.damped, largest_turn / std::max(plant.change.turn, 1.0e-300));
  if (plant.share < 1.0) rows_.set_share(index, plant.share);
  searching_[index] = plant.is_searched();
  if (searching_[index] || !plant.touched) return;
  plant.presses = plant.presses || plant.contacts.potential(model, plant.iterate) > 0.0;
  plant.iterate_is_here = true;
}

// What a small change leaves out of the potential's quadratic model is too little to climb by.
// Before the first change of a step is known, that of the step before stands for it. Contact with
// things outside is stiff enough to be searched always.
bool DirectSolver::Plant::is_searched() const {
  return std::max(change.turn, change.shift) > unsearched_change || !contacts.only_with_itself();
}

void DirectSolver::try_share(int index, const RodModel& model, StepReport& report) {
  Plant& plant = plants_[index];
  double found = rows_.energy(index);
  if (plant.touched) {
    plant.pressed = plant.contacts.potential(model, plant.iterate);
    plant.presses = plant.presses || plant.pressed > 0.0;
    found += plant.attachments.potential(model, plant.iterate) + plant.pressed;
  }
  // Rounding of the sum is the only ascent allowed.
  if (plant.share == 0.0 || found <= plant.energy + 1.0e-12 * (1.0 + std::abs(plant.energy))) {
    searching_[index] = 0;
    plant.iterate_is_here = plant.touched;
    return;
  }
  plant.share *= 0.5;
  if (plant.share < smallest_share) {
    plant.share = 0.0;
    report.errors |= line_search_failed;
  }
  rows_.set_share(index, plant.share);
}

// A move by many radii may end deep in what it was not near before, which the search did not feel:
// the next iteration would find energy there that nothing has put in. So contacts are found again
// at its end, and it is cut until the potential with them has not risen by more than the known ones
// hold. At the share 0 it has not risen.
void DirectSolver::look_again(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  for (int p = 0; p < size(); ++p) {
    const Plant& plant = plants_[p];
    const double moved = plant.share * std::max(plant.change.turn, plant.change.shift);
    searching_[p] = working_[p] && !steps[p].contacts.empty() && moved > looked_after;
  }
  while (any(searching_)) {
    bool cut = false;
    for (int p = 0; p < size(); ++p) {
      if (!searching_[p]) continue;
      Plant& plant = plants_[p];
      const RodModel& model = *steps[p].model;
      lend(&pool, p, steps[p]);
      find_contacts(p, steps[p], dt);
      plant.contacts_are_here = true;
      const double found = rows_.energy(p) + plant.attachments.potential(model, plant.iterate) +
                           plant.contacts.potential(model, plant.iterate);
      lend(nullptr, p, steps[p]);
      searching_[p] = found > plant.energy + plant.pressed && plant.share > 0.0;
      if (!searching_[p]) continue;
      plant.share = plant.share > smallest_share ? 0.5 * plant.share : 0.0;
      rows_.set_share(p, plant.share);
      cut = true;
    }
    if (!cut) break;
    rows_.set_active(searching_);
    rows_.move(pool, false, true, iterates_);
  }
}

// Newton stops when what is left, by the geometric series of its gain an iteration, is below the
// tolerance (Hairer & Wanner, Solving ODEs II, section IV.8). Its first iteration takes the gain
// from an earlier step: larger where the change is larger than then, and trusted less with each
// step that did not measure it.
bool DirectSolver::is_done(Plant& plant, StepReport& report) const {
  const double change = plant.change.largest;
  ++report.iterations;
  report.last_change = change;
  if (settling_ && stop_requested) return true;  // settle() throws
  const bool first = plant.last_change == 0.0;
  double gain = plant.gain * std::max(1.0, change / std::max(plant.gain_change, 1.0e-300));
  if (!first) {
    gain = plant.gain = change / plant.last_change;
    plant.gain_change = plant.last_change;
  }
  plant.last_change = change;
  // A contact that moves a stem by many of its radii in one step wants more iterations than a
  // smooth motion: cut short, the stem may end inside a thin link.
  const bool with_itself = plant.presses && plant.contacts.only_with_itself();
  const double moved = std::max(plant.change.turn, plant.change.shift);
  const double settled = settings_.self_contact_tolerance;
  const bool rough_contact =
      plant.presses && (with_itself ? moved > rough_self_contact * settled && gain < stalled_gain
                                    : change > converged_change);
  int most = (rough_contact ? rough_contact_iterations : 1) * settings_.newton_iterations;
  if (is_part_ && plant.stuck_for > most_knocks && rough_contact && !with_itself) {
    if (!first && gain > cycling_gain) damp(plant);
    if (plant.damped < 1.0) most *= damped_iterations;
  }
  const bool last = report.iterations >= most;
  // Self-contact leaves its coupling out of the Hessian: what the last iterations would do is below
  // what can be seen, and would cost most of the time.
  const double series = gain < 1.0 ? gain / (1.0 - gain) : std::numeric_limits<double>::infinity();
  const double left = series * moved;
  const bool is_settled = moved <= settled || left <= left_over * settled;
  if (last && (with_itself ? !is_settled : change > converged_change))
    report.errors |= not_converged;
  if (with_itself) {
    plant.smooth = is_settled;
    const bool ends = first ? left <= left_over_ahead * settled : is_settled;
    if (ends && first) plant.gain = trusted_less(plant.gain);
    return last || ends;
  }
  // Contacts are found anew in every iteration: there a small change is not yet the end.
  if (plant.presses) return last || change <= 1.0e-4 * settings_.tolerance;
  const bool small = change <= settings_.tolerance || series * change <= settings_.tolerance;
  if (small && first) plant.gain = trusted_less(plant.gain);
  plant.smooth = small;
  return last || small;
}

// A stem that lies flat between a link and the ground is touched in one place of each, and both
// roll from end to end as it tilts: Newton's Hessian does not know, its changes go to and fro for
// ever, and neither place is wrong enough for the line search. With the slope -s of what a change
// leaves of the one before it, shares below 2 / (1 + s) converge.
void DirectSolver::damp(Plant& plant) {
  plant.damped = std::max(0.5 * plant.damped, most_damped);
}

// A stem that is dragged over an edge slides by many of its radii in one step, too far for Newton;
// cut short, it may end on the other side of a thin link. In parts what drags it moves less.
void DirectSolver::take_in_parts(int index, PlantStep& step, double dt, const Vec3& gravity) {
  Plant& plant = plants_[index];
  if (!plant.parts) plant.parts = std::make_unique<DirectSolver>(settings_, *step.model);
  DirectSolver& solver = *plant.parts;
  Plant& alone = solver.plants_.front();
  solver.settings_ = settings_;
  solver.is_part_ = true;
  solver.reset();
  solver.forces_.clear();
  alone.stuck_for = ++plant.stuck_for;
  std::swap(alone.contacts, plant.contacts);
  RodState& state = *step.state;
  plant.iterate = state;
  const Pose from = state.previous_root, to = state.root;
  step.report = {};
  for (int k = 0; k < parts; ++k) {
    for (ContactSource* source : step.contacts)
      source->cover(k / double(parts), (k + 1) / double(parts));
    state.root = k + 1 == parts ? to : between(from, to, (k + 1) / double(parts));
    PlantStep part{step.model, step.state, step.loads, step.contacts, k == 0, k == 0, {}};
    solver.step({&part, 1}, dt / parts, gravity);
    part.report.errors |= step.report.errors;
    part.report.iterations += step.report.iterations;
    if (part.report.element < 0) part.report.element = step.report.element;
    step.report = part.report;
    if (part.report.errors & not_finite) {
      state = plant.iterate;
      break;
    }
    alone.contacts.add_to(solver.forces_, 1.0 / parts);
  }
  for (ContactSource* source : step.contacts) source->cover(0.0, 1.0);
  std::swap(alone.contacts, plant.contacts);
  plant.contacts.report(solver.forces_);
  plant.in_parts = true;
  state.time = plant.iterate.time;
}

void DirectSolver::end(std::span<PlantStep> steps, double dt, ThreadPool& pool) {
  for (int p = 0; p < size(); ++p)  // what steps in parts leave is not in the rows
    if (plants_[p].in_parts || (steps[p].report.errors & not_finite)) states_[p] = nullptr;
  rows_.finish(pool, states_);
  const auto all = [](int) { return true; };
  for_each_plant(steps, pool, all, [&](int p) {
    Plant& plant = plants_[p];
    RodState& state = *steps[p].state;
    StepReport& report = steps[p].report;
    plant.has_history = !plant.in_parts;
    plant.stands_in_rows = states_[p] && std::ranges::find(state.alive, 0) == state.alive.end();
    state.previous_root = state.root;
    if (report.errors & not_finite) {
      state.previous_dt = 0.0;
      return;
    }
    if (plant.in_parts) {
      state.previous_dt = 0.0;
      state.time += dt;
      return;
    }
    if (report.errors != none) report.element = rows_.largest_change(p, state.size());
    plant.contacts.finish(*steps[p].model, state);
    report.contacts = plant.contacts.carrying();
    report.deepest = plant.contacts.deepest();
    // A step whose last iteration still moved things roughly is not on a smooth path: the
    // second-order scheme, which continues that path, would feed on it. The next step is first
    // order and damps.
    const double moved = std::max(plant.change.turn, plant.change.shift);
    const bool unsolved = plant.presses && (report.errors & not_converged);
    const bool rough = moved > (unsolved ? rough_unsolved : rough_change);
    state.previous_dt = rough ? 0.0 : dt;
    state.time += dt;
  });
  rows_.end_step();
}

}  // namespace pedicel::cosserat
