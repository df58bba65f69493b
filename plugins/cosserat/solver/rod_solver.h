#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/parameter.h"
#include "plugins/cosserat/contact/contact.h"
#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

enum class SolverKind { direct, position_based };
enum class Integrator { backward_euler, bdf2 };

/// How the rods are solved. Names, units, bounds and sentences: parameters_of().
struct RodSettings {
  SolverKind solver = SolverKind::direct;
  Integrator integrator = Integrator::bdf2;  ///< direct solver only
  int newton_iterations = 4;                 ///< 1, at most, a step
  /// 1, Newton stops when it expects to be nearer than this (m and rad) to the step's solution.
  double tolerance = 1.0e-5;
  /// rad or element lengths: a step of a plant that touches only itself is solved when an
  /// iteration, from the second on, turns and shifts its elements by less, or leaves less than 0.6
  /// of it by the series of its gain. No parameter: what it is worth is tested at this value.
  double self_contact_tolerance = 5.0e-3;
  int iterations = 5;  ///< 1, position-based: Gauss-Seidel sweeps a sub-step
  int substeps = 1;    ///< 1, position-based
};
std::vector<Parameter> parameters_of(RodSettings& settings);

/// A force on a place of the plant during one step.
struct Load {
  int element = 0;
  double back = 0.0;             ///< m
  Vec3 force_W = Vec3::Zero();   ///< N
  Vec3 moment_W = Vec3::Zero();  ///< N m
};

/// Everything that acts on a plant during one step.
struct StepInput {
  double dt = 0.0;                   ///< s
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< m/s2
  std::span<const Load> loads;
  std::span<ContactSource* const> contacts;
};

/// What went wrong in a step; each bit's remedy is in remedy().
enum StepError : unsigned {
  none = 0,
  not_converged = 1,  ///< Newton's last change is above 1e-3 (m or rad); touching only itself 5e-3
  not_finite = 2,     ///< a position is NaN or infinite: the state was put back to the step before
  line_search_failed = 4,
};
std::string remedy(StepError error);

struct StepReport {
  unsigned errors = none;
  int element = -1;          ///< the element with the largest change
  double last_change = 0.0;  ///< m or rad, of the last iteration
  int iterations = 0;
  int contacts = 0;
  double deepest = 0.0;  ///< m, deepest overlap
};

/// Advances one plant by one step. Holds the scratch memory and the friction memory of that plant,
/// so one solver serves one plant. step() neither throws, nor prints, nor allocates once warm.
class RodSolver {
 public:
  virtual ~RodSolver() = default;
  virtual StepReport step(const RodModel& model, RodState& state, const StepInput& input) = 0;
  /// Contacts that carried a force at the end of the last step.
  virtual const std::vector<ContactForce>& contact_forces() const = 0;
  /// Goes on with other settings, of the same kind of solver.
  virtual void change_settings(const RodSettings& settings) = 0;
  /// Forgets history (after the state was set from outside or the model changed).
  virtual void reset() = 0;
};

std::unique_ptr<RodSolver> make_solver(const RodSettings& settings, const RodModel& model);

}  // namespace pedicel::cosserat
