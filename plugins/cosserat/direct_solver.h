#pragma once

#include "cosserat/assembly.h"
#include "cosserat/block_system.h"
#include "cosserat/contact_terms.h"
#include "cosserat/rod_solver.h"

namespace pedicel::cosserat {

/// Newton's method on the incremental potential of a step, with a positive definite Hessian, the
/// O(n) block elimination of the tree and a backtracking line search (plugins/cosserat/README.md).
class DirectSolver : public RodSolver {
 public:
  DirectSolver(const RodSettings& settings, const RodModel& model);

  StepReport step(const RodModel& model, RodState& state, const StepInput& input) override;
  const std::vector<ContactForce>& contact_forces() const override { return contacts_.forces(); }
  void reset() override;

 private:
  void guess(const RodModel& model, RodState& state, bool first_order) const;
  bool newton(const RodModel& model, RodState& state, const StepInput& input, StepReport& report);
  bool line_search(const RodModel& model, RodState& state, double energy, StepReport& report);
  void move(const RodModel& model, RodState& state, double share) const;
  void remember(const RodModel& model, RodState& state) const;

  RodSettings settings_;
  Assembly assembly_;
  BlockSystem system_;
  ContactTerms contacts_;
  RodState start_;
  bool rough_ = false;  // the last iteration still changed the shape a lot
  std::vector<Vec3> base_position_;     // m, W: the iterate that the line search starts from
  std::vector<Quat> base_orientation_;  // E to W
};

/// Finds the static equilibrium that the state settles into under gravity and loads (Newton with
/// the inertia taken out, damped by nothing: many iterations of one huge backward Euler step).
/// Velocities end at zero. Returns the report of the last iteration; `not_converged` where
/// `iterations` did not do.
StepReport settle(const RodModel& model, RodState& state, const Vec3& gravity,
                  std::span<const Load> loads = {}, int iterations = 500);

}  // namespace pedicel::cosserat
