#include "cosserat/direct_solver.h"

#include <algorithm>
#include <cmath>

#include "cosserat/rotation.h"

namespace pedicel::cosserat {

namespace {

constexpr double largest_turn =
    1.0;  // rad, of one Newton step: beyond it the quadratic model is void
constexpr double converged_change = 1.0e-3;  // m or rad
constexpr double rough_change = 0.3;         // rad, or element lengths
constexpr int most_halvings = 12;
constexpr int rough_contact_iterations = 4;  // times newton_iterations

bool is_finite(const RodState& state) {
  double sum = 0.0;
  for (int e = 0; e < state.size(); ++e)
    sum += state.position[e].sum() + state.orientation[e].coeffs().sum();
  return std::isfinite(sum);
}

}  // namespace

DirectSolver::DirectSolver(const RodSettings& settings, const RodModel& model)
    : settings_(settings),
      assembly_(model),
      system_(model),
      base_position_(model.elements.size()),
      base_orientation_(model.elements.size()) {}

void DirectSolver::reset() {
  contacts_.forget();
}

StepReport DirectSolver::step(const RodModel& model, RodState& state, const StepInput& input) {
  StepReport report;
  const bool first_order =
      settings_.integrator == Integrator::backward_euler || state.previous_dt != input.dt;
  start_ = state;
  for (ContactSource* source : input.contacts) source->begin_step(model, start_, input.dt);
  assembly_.prepare(model, start_, input, first_order);
  guess(model, state, first_order);
  if (!newton(model, state, input, report) || !is_finite(state)) {
    state = start_;
    state.previous_dt = 0.0;
    report.errors |= not_finite;
    return report;
  }
  contacts_.finish(model, state);
  report.contacts = static_cast<int>(contacts_.forces().size());
  report.deepest = contacts_.deepest();
  remember(model, state);
  assembly_.set_velocities(model, state);
  // A step whose last iteration still moved things roughly is not on a smooth path: the
  // second-order scheme, which continues that path, would feed on it. The next step is first order
  // and damps.
  state.previous_dt = rough_ ? 0.0 : input.dt;
  state.time = start_.time + input.dt;
  return report;
}

// Newton starts from the motion continued, so that one iteration is second order in time too.
void DirectSolver::guess(const RodModel& model, RodState& state, bool first_order) const {
  if (first_order) return;
  for (int e = 0; e < model.size(); ++e) {
    state.position[e] = 2.0 * start_.position[e] - start_.previous_position[e];
    state.orientation[e] = (start_.orientation[e] *
                            (start_.previous_orientation[e].conjugate() * start_.orientation[e]))
                               .normalized();
  }
}

bool DirectSolver::newton(const RodModel& model, RodState& state, const StepInput& input,
                          StepReport& report) {
  for (report.iterations = 1;; ++report.iterations) {
    contacts_.find(model, start_, state, input.dt, input.contacts);
    double energy = assembly_.linearise(model, state, system_);
    energy += contacts_.linearise(model, state, system_);
    if (!std::isfinite(energy) || !system_.solve()) return false;
    if (!line_search(model, state, energy, report)) report.errors |= line_search_failed;
    // Contacts are found anew in every iteration, and self-contact leaves its coupling out of the
    // Hessian: there an iteration gains a fixed factor only, so a small change is not yet the end.
    const double tolerance = (contacts_.size() > 0 ? 1.0e-4 : 1.0) * settings_.tolerance;
    if (report.last_change <= tolerance) return true;
    // A contact that moves a stem by many of its radii in one step wants more iterations than a
    // smooth motion: cut short, the stem may end inside a thin link.
    const bool rough_contact = contacts_.size() > 0 && report.last_change > converged_change;
    const int most = (rough_contact ? rough_contact_iterations : 1) * settings_.newton_iterations;
    if (report.iterations >= most) break;
  }
  if (report.last_change > converged_change) report.errors |= not_converged;
  return true;
}

bool DirectSolver::line_search(const RodModel& model, RodState& state, double energy,
                               StepReport& report) {
  double turn = 0.0, shift = 0.0;
  report.last_change = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    const Vec6& d = system_.solution(e);
    turn = std::max(turn, d.tail<3>().norm());
    shift = std::max(shift, d.head<3>().norm() / model.elements[e].length);
    const double change = d.cwiseAbs().maxCoeff();
    if (change > report.last_change) report.element = e;
    report.last_change = std::max(report.last_change, change);
  }
  rough_ = turn > rough_change || shift > rough_change;
  base_position_ = state.position;
  base_orientation_ = state.orientation;
  double share = std::min(1.0, largest_turn / std::max(turn, 1.0e-300));
  for (int i = 0; i < most_halvings; ++i, share *= 0.5) {
    move(model, state, share);
    const double found = assembly_.potential(model, state) + contacts_.potential(model, state);
    // Rounding of the sum is the only ascent allowed.
    if (found <= energy + 1.0e-12 * (1.0 + std::abs(energy))) return true;
  }
  state.position = base_position_;
  state.orientation = base_orientation_;
  return false;
}

void DirectSolver::move(const RodModel& model, RodState& state, double share) const {
  for (int e = 0; e < model.size(); ++e) {
    const Vec6& d = system_.solution(e);
    state.position[e] = base_position_[e] + share * d.head<3>();
    state.orientation[e] = (exp_map(share * d.tail<3>()) * base_orientation_[e]).normalized();
  }
}

// What the next step needs to know of the step that ends here.
void DirectSolver::remember(const RodModel& model, RodState& state) const {
  state.previous_position = start_.position;
  state.previous_orientation = start_.orientation;
  state.previous_velocity = start_.velocity;
  state.previous_angular_velocity = start_.angular_velocity;
  for (int e = 0; e < model.size(); ++e) {
    if (model.elements[e].damping_time == 0.0) continue;
    const Strain strain = strain_of(model, start_, e);
    state.previous_stretch[e] = strain.stretch;
    state.previous_bend[e] = strain.bend;
  }
}

StepReport settle(const RodModel& model, RodState& state, const Vec3& gravity,
                  std::span<const Load> loads, int iterations) {
  RodSettings settings;
  settings.integrator = Integrator::backward_euler;
  settings.newton_iterations = iterations;
  settings.tolerance = 1.0e-10;
  DirectSolver solver(settings, model);
  StepInput input;
  input.dt = 1.0e3;  // s: inertia and damping weigh nothing against stiffness
  input.gravity = gravity;
  input.loads = loads;
  const double time = state.time;
  const auto rest = [&] {
    for (int e = 0; e < state.size(); ++e) {
      state.velocity[e].setZero();
      state.angular_velocity[e].setZero();
    }
    state.previous_dt = 0.0;
    state.time = time;
  };
  rest();
  StepReport report = solver.step(model, state, input);
  rest();
  return report;
}

}  // namespace pedicel::cosserat
