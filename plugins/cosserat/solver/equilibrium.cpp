#include "plugins/cosserat/solver/equilibrium.h"

#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/settle_touching.h"

namespace pedicel::cosserat {

namespace {

constexpr int iterations = 100;
constexpr double first_step = 1.0e-3, last_step = 1.0e2, growth = 1.5;  // s, s, 1

void stop(RodState& state) {
  for (int e = 0; e < state.size(); ++e) {
    state.velocity[e].setZero();
    state.angular_velocity[e].setZero();
  }
  state.previous_dt = 0.0;
}

// Pseudo-transient continuation: a step that starts from rest goes down the potential, held back by
// inertia less and less.
void sink(const RodModel& model, RodState& state, const Vec3& gravity, std::span<const Load> loads,
          std::span<ContactSource* const> contacts) {
  RodSettings settings;
  settings.integrator = Integrator::backward_euler;
  settings.newton_iterations = iterations;
  DirectSolver solver(settings, model);
  const double time = state.time;
  for (double dt = first_step; dt < last_step; dt *= growth) {
    solver.step(model, state, {dt, gravity, loads, contacts});
    stop(state);
  }
  state.time = time;
}

}  // namespace

bool find_equilibrium(const RodModel& model, RodState& state, const Vec3& gravity,
                      std::span<const Load> loads, std::span<ContactSource* const> contacts) {
  const auto settles = [&] {
    return settle_touching(model, state, gravity, loads, contacts, iterations).errors == none;
  };
  const RodState start = state;
  if (settles()) return true;
  state = start;
  sink(model, state, gravity, loads, contacts);
  return settles();
}

bool hang(RodModel& model, const RodModel& unladen, RodState state, const Vec3& gravity) {
  RodModel relaxed = relaxed_for_long(unladen);
  relaxed.air.clear();
  const bool found = find_equilibrium(relaxed, state, gravity, {});
  keep_hung_shape(model, state);
  return found;
}

}  // namespace pedicel::cosserat
