#include "engine/core/stop.h"
#include "plugins/cosserat/model/joint_law.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/settle_touching.h"

namespace pedicel::cosserat {

StepReport settle(const RodModel& model, RodState& state, const Vec3& gravity,
                  std::span<const Load> loads, int iterations) {
  return settle_touching(model, state, gravity, loads, {}, iterations);
}

StepReport settle_touching(const RodModel& model, RodState& state, const Vec3& gravity,
                           std::span<const Load> loads, std::span<ContactSource* const> contacts,
                           int iterations) {
  RodSettings settings;
  settings.integrator = Integrator::backward_euler;
  settings.newton_iterations = iterations;
  settings.tolerance = 1.0e-10;
  DirectSolver solver(settings, model);
  StepInput input;
  input.dt = 1.0e3;  // s: inertia and damping weigh nothing against stiffness
  input.gravity = gravity;
  input.loads = loads;
  input.contacts = contacts;
  const double time = state.time;
  const auto rest = [&] {
    for (int e = 0; e < state.size(); ++e) {
      state.velocity[e].setZero();
      state.angular_velocity[e].setZero();
    }
    state.previous_dt = 0.0;
    state.time = time;
  };
  // Where a strong wind turns segments far, the drag is to follow them slowly: the force that turns
  // with them is not in the Hessian.
  start_settling(model, state);
  StepReport report;
  const bool extended = is_extended(model);
  constexpr double followed = 1.0e-8;  // m or rad
  for (const double share : {1.0, 0.3, 0.1, 0.03}) {
    solver.set_settling(true, share);
    // The second step has next to no way to go, and so nothing that damps it.
    for (int i = 0; i < (extended ? 2 : 1); ++i) {
      rest();
      report = solver.step(model, state, input);
      throw_if_stopped();
    }
    if (model.air.empty() || (report.errors == none && report.last_change <= followed)) break;
  }
  rest();
  start_memory(model, state);
  return report;
}

}  // namespace pedicel::cosserat
