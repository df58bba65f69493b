#pragma once

#include <vector>

#include "pedicel/cosserat/solver/rod_solver.h"

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
/// the clamp to stand still. Corrections are clamped to one segment's length and half a radian
/// each, so that nothing overflows.
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
  struct Body {
    double node_mass = 0.0, inverse_mass = 0.0;  // kg, of the child node
    Vec3 inverse_inertia = Vec3::Zero();         // 1/(kg m2), E
    Vec3 velocity = Vec3::Zero();                // m/s, of the child node, W
    Vec3 spin = Vec3::Zero();                    // rad/s, E
    Vec3 force = Vec3::Zero();                   // N, on the child node, W
    Vec3 moment = Vec3::Zero();                  // N m, W
    Vec3 position = Vec3::Zero();                // at the sub-step's start
    Quat orientation = Quat::Identity();
  };
  struct Contact {
    ContactPoint point;
    Vec3 place = Vec3::Zero(), found_at = Vec3::Zero();  // on the centreline: sub-step start, found
    double normal = 0.0;                                 // multipliers, kg m
    Vec3 tangential = Vec3::Zero();
    bool slipping = false;
  };

  void remember(const RodState& state);
  void restore(RodState& state) const;
  void share_masses(const RodModel& model, const RodState& state);
  void gather_loads(const RodModel& model, const RodState& state, const StepInput& input);
  void predict(const RodModel& model, RodState& state);
  void clear_multipliers();
  void find_contacts(const RodModel& model, const RodState& state, const StepInput& input);
  void sweep(const RodModel& model, RodState& state, double surface_share);
  void project_stretch(const RodModel& model, RodState& state, int element);
  void project_bend(const RodModel& model, RodState& state, int element);
  void project_support(const RodModel& model, RodState& state, int support);
  void project_weld(const RodModel& model, RodState& state, int weld);
  void project_contact(const RodModel& model, RodState& state, Contact& contact,
                       double surface_share);
  void update_velocities(const RodModel& model, RodState& state);
  void report_contacts(const RodModel& model, const RodState& state, StepReport& report);

  void damp_stretch(const RodModel& model, const RodState& state, int element);
  void damp_bend(const RodModel& model, const RodState& state, int element);

  Mat3 stretch_response(const RodModel& model, int element, const Mat3& by_turn) const;
  Mat3 bend_response(const RodModel& model, int element, const Mat3& to_parent) const;
  Vec3 multiplier_step(const Mat3& response, const Vec3& compliance, const Vec3& value,
                       Vec3& lambda) const;
  Vec3 damping_impulse(const Mat3& response, const Vec3& damping, const Vec3& rate) const;
  void move_node(RodState& state, int element, const Vec3& change, double limit);
  void move_place(const RodModel& model, RodState& state, int element, double back,
                  const Vec3& impulse);
  void turn(RodState& state, int element, const Vec3& delta);
  double inverse_mass(int element) const {
    return element < 0 ? 0.0 : bodies_[element].inverse_mass;
  }
  double inverse_mass_at(const RodModel& model, int element, double back) const;

  RodSettings settings_;
  double h_ = 0.0;  // s, sub-step
  std::vector<Body> bodies_;
  // Multipliers of the sub-step: N s2 and N m s2, in the constraint's own axes.
  std::vector<Vec3> stretch_, bend_, support_position_, support_rotation_, weld_position_,
      weld_rotation_;
  std::vector<ContactPoint> found_;
  std::vector<Contact> contacts_;
  std::vector<ContactForce> forces_;
  std::vector<Vec3> old_position_, old_velocity_, old_angular_velocity_;
  std::vector<Quat> old_orientation_;
  double largest_change_ = 0.0;  // m or rad, of the last sweep
  int largest_element_ = -1;
};

}  // namespace pedicel::cosserat
