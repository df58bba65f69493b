#pragma once

#include <vector>

#include "plugins/cosserat/solver/position_based_projections.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// The solver of *Gazebo Plants* (Deng et al., arXiv 2402.02570): position-based dynamics on the
/// constraints of Kugelstadt & Schoemer (SCA 2016; position_based_constraints.h). Kept so that the
/// paper's experiments can be repeated and compared; DirectSolver is the one to trust.
///
/// A sub-step predicts every node and orientation explicitly (gravity, loads, gyroscopic moment,
/// mass damping), then makes `iterations` Gauss-Seidel sweeps from the root outward, each
/// constraint moving its nodes and orientations in the ratio of their inverse masses and inverse
/// inertias; the velocities are the differences over the sub-step.
///
/// How Young's modulus enters. Kugelstadt & Schoemer scale each correction by a factor in [0, 1],
/// which has no unit, while the paper gives moduli in Pa; the sources at hand do not say how its
/// plug-in turns one into the other. Chosen: the compliant constraints of Macklin, Mueller &
/// Chentanez, "XPBD" (MIG 2016), eq. 18, with the same stiffnesses as the direct solver:
/// (kGA, kGA, EA)/l for stretch and shear, and the joint's for bend and twist (half of each
/// segment; a clamp counts half its segment). Converged sweeps would then give the direct solver's
/// beam. A few sweeps do not converge, the less so the more nodes there are: that is why stiffness
/// depends on the number of nodes, as the paper saw.
///
/// Kelvin-Voigt damping acts on the velocities at the end of a sub-step, one implicit impulse a
/// joint from the root outward. (Inside the constraints, as in XPBD's eq. 26, it would stiffen them
/// by 1 + damping_time / h, and the sweeps would converge that much worse: measured, a plant that
/// should sag 13 mm sagged 200 mm.)
///
/// Limits. Masses are shared to a segment's two nodes by the lever rule about its centre of mass
/// and its inertia turns its orientation, so that a beam's rotary inertia is counted too high by
/// O(length^2). Contacts are found once a sub-step (linearised after that), act on the centreline
/// (friction does not twist a stem), and colliders stand at their end-of-step poses. Damping takes
/// the clamp to stand still.
class PositionBasedSolver final : public RodSolver {
 public:
  PositionBasedSolver(const RodSettings& settings, const RodModel& model);

  StepReport step(const RodModel& model, RodState& state, const StepInput& input) override;
  /// Forces of the last sub-step: accumulated correction x mass / h^2.
  const std::vector<ContactForce>& contact_forces() const override { return forces_; }
  /// There is no history beyond positions and velocities: only the contact forces are dropped.
  void change_settings(const RodSettings& settings) override { settings_ = settings; }
  void reset() override { forces_.clear(); }

 private:
  using Body = PositionBasedProjections::Body;
  using Contact = PositionBasedProjections::Contact;

  void remember(const RodState& state);
  void restore(RodState& state) const;
  void share_masses(const RodModel& model, const RodState& state);
  void gather_loads(const RodModel& model, const RodState& state, const StepInput& input);
  void predict(const RodModel& model, RodState& state);
  void find_contacts(const RodModel& model, const RodState& state, const StepInput& input);
  void update_velocities(const RodModel& model, RodState& state);
  void report_contacts(const RodModel& model, const RodState& state, StepReport& report);

  RodSettings settings_;
  double h_ = 0.0;  // s, sub-step
  PositionBasedProjections projections_;
  std::vector<ContactPoint> found_;
  std::vector<Contact> contacts_;
  std::vector<ContactForce> forces_;
  std::vector<Vec3> old_position_, old_velocity_, old_angular_velocity_;
  std::vector<Quat> old_orientation_;
};

}  // namespace pedicel::cosserat
