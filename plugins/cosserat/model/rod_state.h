#pragma once

#include <vector>

#include "plugins/cosserat/model/rod_model.h"

namespace pedicel::cosserat {

/// What changes while a plant moves. One entry an element.
struct RodState {
  std::vector<Vec3> position;          ///< m, W, child node
  std::vector<Quat> orientation;       ///< E to W, unit
  std::vector<Vec3> velocity;          ///< m/s, W, of the centre of mass
  std::vector<Vec3> angular_velocity;  ///< rad/s, in E
  std::vector<char> alive;             ///< 0 once the element has come off
  std::vector<bool> fruit_gone;        ///< one entry a fruit
  Pose root;                           ///< X_W of the clamp, now
  Pose previous_root;                  ///< X_W of it at the end of the last step: what `root` moved
                                       ///< by since is its motion in the next one
  double time = 0.0;                   ///< s

  // Memory of joints with laws (joint_law.h), rad in E; empty until start_memory().
  std::vector<Vec3> joint_memory;  ///< z of each branch, branch_count() an element
  std::vector<Vec3> joint_bias;    ///< JointLaw::anchored times phi of the settled shape

  /// s, of the step that ended here, if its solver may go on from it at second order; 0: the next
  /// step is of first order. Set it to 0 after changing a state.
  double previous_dt = 0.0;

  int size() const { return static_cast<int>(position.size()); }
};

/// At rest in the drawn shape.
RodState drawn_state(const RodModel& model);

/// Near end of an element: its parent's node, or the clamp.
Vec3 start_of(const RodModel& model, const RodState& state, int element);

/// A place on an element, interpolated between its two nodes.
Vec3 point_on(const RodModel& model, const RodState& state, int element, double back);

/// Velocity of a place on an element (m/s, W).
Vec3 velocity_on(const RodModel& model, const RodState& state, int element, double back);

/// Strain of a segment and its joint, from the unloaded rest shape.
struct Strain {
  Vec3 stretch = Vec3::Zero();  ///< 1, (shear 1, shear 2, stretch), in E
  Vec3 bend = Vec3::Zero();     ///< rad, (bend 1, bend 2, twist), in E
};
Strain strain_of(const RodModel& model, const RodState& state, int element);
/// Its parts: the stretch, and the rotation that `bend` is the rotation vector of.
Vec3 stretch_of(const RodModel& model, const RodState& state, int element);
Quat turn_of(const RodModel& model, const RodState& state, int element);

/// Elastic force (N) and moment (N m) of a segment and its joint, in E.
struct JointLoad {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};
JointLoad joint_load(const RodModel& model, const RodState& state, int element);

/// Energy of a plant (J).
struct Energy {
  double kinetic = 0.0, elastic = 0.0, gravity = 0.0;
  double total() const { return kinetic + elastic + gravity; }
};
Energy energy_of(const RodModel& model, const RodState& state, const Vec3& gravity);

}  // namespace pedicel::cosserat
