#pragma once

#include <span>
#include <vector>

#include "cosserat/block_system.h"
#include "cosserat/rod_solver.h"
#include "cosserat/rod_state.h"

namespace pedicel::cosserat {

/// What one element contributes to the incremental potential of one step. With h~ = beta dt (beta 1
/// for backward Euler, 2/3 for BDF2) and starred values the scheme's combination of the past, the
/// inertia, the Kelvin-Voigt damping (dissipation K tau |strain - strain*|^2 / (2 h~)) and the mass
/// damping all fold into springs towards a target:
///   inertia   1/2 mass/h~^2 (1 + rate h~) |c - c_target|^2   c_target = c* + h~ v* / (1 + rate h~)
///   rods      1/2 K (1 + tau/h~) |strain - strain_target|^2  strain_target = strain* tau / (h~ +
///   tau)
struct ElementTerms {
  Vec3 com_target, stretch_target, bend_target;  ///< m, W; 1, E; rad, E
  Quat rotation_target;                          ///< E to W
  Vec3 stretch_stiffness, bend_stiffness;        ///< N, N m/rad, with damping
  double inertia_weight = 0.0;                   ///< N/m
  Vec3 rotation_weight;                          ///< N m/rad, E
  Vec3 weight;                                   ///< N, W: gravity, at the centre of mass
};

/// The incremental potential of a plant over one step, without contact: its value, and its gradient
/// with a positive definite Hessian (Gauss-Newton plus the tension's geometric stiffness).
class Assembly {
 public:
  explicit Assembly(const RodModel& model);

  /// Sets the terms of the step that starts from `start` (first order where `first_order`).
  void prepare(const RodModel& model, const RodState& start, const StepInput& input,
               bool first_order);

  /// Adds the gradient (negative, as right side) and the Hessian at `state` to `system` and returns
  /// the potential (J) relative to nothing in particular; also makes `state` the reference from
  /// which dead moments count their work.
  double linearise(const RodModel& model, const RodState& state, BlockSystem& system);

  /// The potential at `state`.
  double potential(const RodModel& model, const RodState& state) const;

  /// Velocities that the scheme assigns to the end of the step.
  void set_velocities(const RodModel& model, RodState& end) const;

  double effective_step() const { return step_; }

 private:
  double rod(const RodModel& model, const RodState& state, int e, BlockSystem* system) const;
  double inertia(const RodModel& model, const RodState& state, int e, BlockSystem* system) const;
  double load(const RodState& state, const Load& load, BlockSystem* system) const;
  double support(const RodState& state, const Support& support, BlockSystem* system) const;
  double weld(const RodModel& model, const RodState& state, int index, BlockSystem* system) const;
  double sum(const RodModel& model, const RodState& state, BlockSystem* system) const;

  std::vector<ElementTerms> terms_;
  std::vector<Vec3> com_past_;          // m, W: c*
  std::vector<Quat> rotation_past_;     // E to W: q*
  std::vector<Quat> moment_reference_;  // E to W: where dead moments have done no work
  std::span<const Load> loads_;
  double step_ = 0.0;  // s: h~
};

}  // namespace pedicel::cosserat
