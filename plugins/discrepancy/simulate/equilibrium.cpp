#include "pedicel/discrepancy/simulate/equilibrium.h"

#include "pedicel/cosserat/solver/direct_solver.h"
#include "pedicel/cosserat/solver/settle_touching.h"

namespace pedicel::discrepancy {

namespace {

constexpr int iterations = 100;
constexpr double first_step = 1.0e-3, last_step = 1.0e2, growth = 1.5;  // s, s, 1

void stop(cosserat::RodState& state) {
  for (int e = 0; e < state.size(); ++e) {
    state.velocity[e].setZero();
    state.angular_velocity[e].setZero();
  }
  state.previous_dt = 0.0;
}

// Pseudo-transient continuation: a step that starts from rest goes down the potential, held back by
// inertia less and less.
void sink(const cosserat::RodModel& model, cosserat::RodState& state, const Vec3& gravity,
          std::span<const cosserat::Load> loads,
          std::span<cosserat::ContactSource* const> contacts) {
  cosserat::RodSettings settings;
  settings.integrator = cosserat::Integrator::backward_euler;
  settings.newton_iterations = iterations;
  cosserat::DirectSolver solver(settings, model);
  const double time = state.time;
  for (double dt = first_step; dt < last_step; dt *= growth) {
    solver.step(model, state, {dt, gravity, loads, contacts});
    stop(state);
  }
  state.time = time;
}

}  // namespace

bool find_equilibrium(const cosserat::RodModel& model, cosserat::RodState& state,
                      const Vec3& gravity, std::span<const cosserat::Load> loads,
                      std::span<cosserat::ContactSource* const> contacts) {
  const auto settles = [&] {
    return cosserat::settle_touching(model, state, gravity, loads, contacts, iterations).errors ==
           cosserat::none;
  };
  const cosserat::RodState start = state;
  if (settles()) return true;
  state = start;
  sink(model, state, gravity, loads, contacts);
  return settles();
}

bool hang(cosserat::RodModel& model, const cosserat::RodModel& unladen, cosserat::RodState state,
          const Vec3& gravity) {
  cosserat::RodModel relaxed = cosserat::relaxed_for_long(unladen);
  relaxed.air.clear();
  const bool found = find_equilibrium(relaxed, state, gravity, {});
  cosserat::keep_hung_shape(model, state);
  return found;
}

}  // namespace pedicel::discrepancy
