#pragma once

#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/cosserat/model/rod_model.h"
#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// The constraints and dampers of PositionBasedSolver. Each projection moves the nodes and
/// orientations of one constraint in the ratio of their inverse masses and inverse inertias.
/// Corrections are clamped to one segment's length and half a radian each, so that nothing
/// overflows.
class PositionBasedProjections {
 public:
  /// A node with the orientation of its segment, over one sub-step.
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
  /// The largest correction of the last sweep.
  struct Change {
    double size = 0.0;  ///< m or rad
    int element = -1;
  };

  explicit PositionBasedProjections(const RodModel& model);

  /// Those of the elements, to be set before the sweeps.
  std::vector<Body>& bodies() { return bodies_; }
  /// A sub-step of `h` seconds begins: no constraint has pushed yet.
  void begin(double h);
  /// A sweep over all constraints, from the root outward and the contacts last. `surface_share`: 1,
  /// of the colliders' motion that they have made.
  void sweep(const RodModel& model, RodState& state, std::vector<Contact>& contacts,
             double surface_share);
  const Change& change() const { return change_; }
  /// One implicit impulse of Kelvin-Voigt damping in an element's joint, on velocity and spin.
  void damp(const RodModel& model, const RodState& state, int element);

 private:
  void project_stretch(const RodModel& model, RodState& state, int element);
  void project_bend(const RodModel& model, RodState& state, int element);
  void project_support(const RodModel& model, RodState& state, int support);
  void project_weld(const RodModel& model, RodState& state, int weld);
  void project_contact(const RodModel& model, RodState& state, Contact& contact,
                       double surface_share);
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

  double h_ = 0.0;  // s, sub-step
  std::vector<Body> bodies_;
  // Multipliers of the sub-step: N s2 and N m s2, in the constraint's own axes.
  std::vector<Vec3> stretch_, bend_, support_position_, support_rotation_, weld_position_,
      weld_rotation_;
  Change change_;
};

}  // namespace pedicel::cosserat
