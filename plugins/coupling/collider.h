#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/geometry/aabb.h"
#include "engine/geometry/signed_distance.h"
#include "plugins/cosserat/contact/contact_drive.h"

namespace pedicel::coupling {

/// Something that plants may touch: one shape of a robot's link, of a rigid body, or of the ground.
/// C is the frame of its signed distance field.
struct Collider {
  std::string name;  ///< "gripper/finger_left"
  int body = 0;      ///< whose: the caller's number of a robot or rigid body
  int link = -1;     ///< which link of it, in the caller's numbering
  std::shared_ptr<const geometry::SignedDistance> shape;  ///< in C
  Pose X_LC;                                              ///< of the shape in its link
  std::optional<double> friction;  ///< 1, against plants; absent: CouplingSettings::friction
  double feature = 0.0;  ///< m, size of its smallest part; 0: the smallest extent of its bounds
};

/// Where a collider is.
struct Placement {
  Pose X_WC;         ///< at the end of the step
  Pose X_WC_before;  ///< at the end of the step before
  Mat3 R_WC = Mat3::Identity(), R_WC_before = Mat3::Identity();
  geometry::Aabb box_W;    ///< m, around both poses; infinite for a plane
  bool is_moving = false;  ///< the two poses differ
  bool is_active = true;   ///< false: plants pass through
  double give = 0.0;       ///< m/N, ContactPoint::give; 0: it does not feel the plants
  /// Which drive presses it, -1: none, and how it moves for each m or rad of that: as a body of
  /// which the point at the world's origin moves by `drive_linear_W`.
  int drive = -1;
  Vec3 drive_linear_W = Vec3::Zero(), drive_angular_W = Vec3::Zero();
};

/// All colliders of a world, shared by the sources of all plants: those only read it, so plants may
/// be stepped side by side.
class ColliderSet {
 public:
  /// Returns its index, which stays. Throws UsageError where the shape is missing or the friction
  /// is out of bounds. May be called between steps (a fruit that fell).
  int add(Collider collider, const Pose& X_WL);

  /// Once a step, after the rigid bodies moved and before the plants do: the poses of the links at
  /// the end of the step, one a collider. Throws nothing and does not allocate.
  void update(std::span<const Pose> X_WL);
  /// Puts one collider somewhere without any motion (after a reset, or a hidden thing's return).
  void put(int index, const Pose& X_WL);
  /// m/N, >= 0: how far the collider's link gives way in a step for each newton (two-way coupling).
  void set_give(int index, double give) { placements_[index].give = give; }
  /// Adds a joint that presses colliders with a limited force; returns its index, which stays.
  int add_drive();
  /// Once a step, with the poses of update().
  void set_drive(int drive, const cosserat::ContactDrive& now) { drives_[drive] = now; }
  /// Likewise: the collider moves with the drive as Placement says.
  void press(int index, int drive, const Vec3& linear_W, const Vec3& angular_W);
  const std::vector<cosserat::ContactDrive>& drives() const { return drives_; }
  void set_active(int index, bool active) { placements_[index].is_active = active; }

  int size() const { return static_cast<int>(colliders_.size()); }
  const Collider& collider(int index) const { return colliders_[index]; }
  const Placement& placement(int index) const { return placements_[index]; }
  /// The pose of the collider's link at the end of the step.
  Pose link_pose(int index) const;

 private:
  std::vector<Collider> colliders_;
  std::vector<Placement> placements_;
  std::vector<cosserat::ContactDrive> drives_;
};

}  // namespace pedicel::coupling
