#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/cosserat/lanes/lane_kernels.h"
#include "plugins/cosserat/solver/attachments.h"
#include "plugins/cosserat/solver/block_system.h"
#include "plugins/cosserat/solver/rod_rows.h"
#include "tests/property/rods/garden_check.h"
#include "tests/property/rods/plain_rotation.h"
#include "tests/property/rods/plain_step.h"

namespace pedicel::plain {

using cosserat::RodHistory;
using cosserat::RodModel;
using cosserat::RodState;

namespace {

// The rows keep the factors L and W in single precision; poses and terms are in double.
constexpr double single = std::numeric_limits<float>::epsilon(),
                 twice = std::numeric_limits<double>::epsilon();
constexpr double rounded_factors = single, rounded_places = 200.0 * twice;

RodState earlier(const RodState& state, double dt) {
  RodState before = state;
  for (int e = 0; e < state.size(); ++e) {
    before.position[e] -= dt * state.velocity[e];
    before.orientation[e] = state.orientation[e] * turn_by(-dt * state.angular_velocity[e]);
  }
  before.root = before.previous_root;
  return before;
}

RodHistory history_of(const RodModel& model, const RodState& before) {
  RodHistory history{
      before.position, before.orientation, before.velocity, before.angular_velocity, {}, {}};
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Strain strain = cosserat::strain_of(model, before, e);
    history.stretch.push_back(strain.stretch);
    history.bend.push_back(strain.bend);
  }
  return history;
}

// One plant's part of the problem.
struct Part {
  const Garden::Plant& plant;
  RodState start, before, iterate;
  RodHistory history;
  cosserat::Attachments attachments;
  cosserat::DiagonalBlocks extras;
  std::unique_ptr<cosserat::BlockSystem> loops;

  Part(const Garden& garden, const Garden::Plant& one)
      : plant(one),
        start(one.start),
        before(earlier(one.start, garden.dt)),
        iterate(one.start),
        history(history_of(one.model, before)),
        extras(one.model.size()) {
    start.root = start.root * one.clamp_motion;
    const Place guess = step(garden).first_guess();
    iterate.position = guess.position;
    iterate.orientation = guess.orientation;
    iterate.root = start.root;
    // Parts with loops are solved in the rows, unless they are too large for that.
    const bool by_blocks = !cosserat::loop_parts(one.model);
    attachments = cosserat::Attachments(by_blocks);
    attachments.prepare(start, one.loads, {});
    attachments.linearise(one.model, iterate, extras);
    if (by_blocks) loops = std::make_unique<cosserat::BlockSystem>(one.model);
  }
  bool second_order(const Garden& garden) const {
    return garden.settings.integrator == cosserat::Integrator::bdf2;
  }
  Step step(const Garden& garden) const {
    return {plant.model, start,          second_order(garden) ? &before : nullptr,
            garden.dt,   garden.gravity, plant.loads};
  }
};

bool solve_loops(cosserat::RodRows& rows, int index, Part& part) {
  cosserat::BlockSystem& system = *part.loops;
  rows.elimination.copy_blocks(index, system);
  for (const auto& entry : part.extras.entries()) {
    system.diagonal(entry.element) += entry.diagonal;
    system.right_side(entry.element) += entry.right_side;
  }
  for (std::size_t w = 0; w < part.plant.model.welds.size(); ++w)
    system.weld(static_cast<int>(w)) =
        cosserat::weld_coupling(part.iterate, part.plant.model.welds[w]);
  if (!system.solve()) return false;
  rows.elimination.set_change(index, system);
  return true;
}

using Changes = std::vector<std::vector<Six>>;  // by plant

// Empty where a pivot was not positive.
Changes solve_in_lanes(const Garden& garden, std::vector<Part>& parts, int threads) {
  std::vector<const RodModel*> models;
  std::vector<const RodState*> states;
  for (const Part& part : parts) {
    models.push_back(&part.plant.model);
    states.push_back(&part.start);
  }
  cosserat::RodRows rows(models, threads);
  ThreadPool pool(threads);
  rows.store.gravity = garden.gravity;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    const int p = static_cast<int>(i);
    rows.states.set_scheme(p, garden.dt, part.second_order(garden) ? garden.dt : 0.0,
                           std::array{cosserat::own_clamp(part.start)});
    rows.extensions.begin_step(p, part.plant.model, part.start.time, garden.dt, false);
    rows.states.set_history(p, part.history);
  }
  rows.states.prepare(pool, states);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    rows.states.read_iterate(static_cast<int>(i), parts[i].iterate);
    if (!parts[i].loops) rows.elimination.add_extras(static_cast<int>(i), parts[i].extras.packed());
  }
  rows.elimination.eliminate(pool);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].loops && !solve_loops(rows, static_cast<int>(i), parts[i])) return {};
  rows.elimination.substitute(pool);
  Changes changes(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const int p = static_cast<int>(i);
    if (!rows.elimination.healthy(p)) return {};
    for (int e = 0; e < parts[i].plant.model.size(); ++e)
      changes[i].push_back(rows.elimination.change(p, e));
  }
  return changes;
}

// The largest part of what rounding may leave of the residual.
double residual_share(const Part& part, const System& system, const std::vector<Six>& change) {
  std::vector<Six> errors;
  for (std::size_t e = 0; e < change.size(); ++e) {
    Six one = rounded_factors * change[e].cwiseAbs();
    one.head<3>().array() += rounded_places * (1.0 + part.iterate.position[e].norm());
    one.tail<3>().array() += rounded_places;
    errors.push_back(one);
  }
  const std::vector<Six> left = residual(system, change), bound = residual_bound(system, errors);
  double largest = 0.0;
  for (std::size_t e = 0; e < change.size(); ++e) {
    if (!change[e].allFinite()) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, left[e].cwiseAbs().cwiseQuotient(bound[e]).maxCoeff());
  }
  return largest;
}

}  // namespace

void check_solution(const Garden& garden, Outcome& outcome) {
  std::vector<Part> parts;
  parts.reserve(garden.plants.size());
  for (const Garden::Plant& plant : garden.plants) parts.emplace_back(garden, plant);
  std::vector<System> systems;
  for (const Part& part : parts)
    systems.push_back(part.step(garden).linearise(place_of(part.iterate)));
  for (const std::string& name : cosserat::available_instruction_sets()) {
    cosserat::use_instruction_set(name);
    const Changes one = solve_in_lanes(garden, parts, 1), two = solve_in_lanes(garden, parts, 2);
    cosserat::use_instruction_set("");
    if (one.size() != parts.size())
      outcome.fault = name + ": a pivot is not positive";
    else if (one != two)
      outcome.fault = name + ": two threads solve to other bits than one";
    for (std::size_t i = 0; i < parts.size() && outcome.fault.empty(); ++i) {
      const double share = residual_share(parts[i], systems[i], one[i]);
      outcome.residual = std::max(outcome.residual, share);
      if (!(share <= 1.0))
        outcome.fault = name + ": plant " + std::to_string(i) + ": the residual is " +
                        std::to_string(share) + " times what rounding may leave";
    }
    if (!outcome.fault.empty()) return;
  }
}

Outcome check_garden(const Garden& garden) {
  Outcome outcome;
  check_solution(garden, outcome);
  if (outcome.fault.empty()) check_steps(garden, outcome);
  return outcome;
}

}  // namespace pedicel::plain
