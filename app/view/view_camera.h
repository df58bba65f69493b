#pragma once

#include "engine/render/camera.h"

namespace pedicel::app {

/// A camera led by hand: it looks at a point that it turns about, Z up.
class ViewCamera {
 public:
  ViewCamera() = default;
  /// Takes over a camera's eye, target and field of view.
  explicit ViewCamera(const render::Camera& camera) { set(camera); }
  void set(const render::Camera& camera);

  render::Camera camera() const;
  const Vec3& target() const { return target_; }
  double distance() const { return distance_; }

  /// Turns about the target by px of a drag in a picture of that height (half a turn a height).
  void orbit(double dx, double dy, int height);
  /// Moves along the picture: what lies at the target's depth stays under the pointer.
  void pan(double dx, double dy, int height);
  /// Moves the eye by steps of a wheel (> 0: nearer) towards the place `towards_W` under the
  /// pointer, which stays where it is in the picture.
  void dolly(double steps, const Vec3& towards_W);
  /// The eye does not go below that height (m): the view gets flatter, or moves up as a whole.
  void stay_above(double height);
  /// Turns about that place from now on; the eye stays.
  void look_at(const Vec3& target_W);
  /// Shows the whole box from the present direction.
  void frame(const Eigen::AlignedBox3d& box, double aspect);

  bool operator==(const ViewCamera&) const = default;

 private:
  Vec3 back() const;  // unit, from the target to the eye

  Vec3 target_ = Vec3::Zero();  // m, W
  double azimuth_ = -1.0;       // rad about Z, 0 looks from +X
  double elevation_ = 0.3;      // rad
  double distance_ = 2.0;       // m
  double field_of_view_ = 0.7;  // rad
};

}  // namespace pedicel::app
