#pragma once

#include "engine/core/frames.h"
#include "engine/geometry/ray.h"

namespace pedicel::render {

using Mat4 = Eigen::Matrix4d;

/// A place in a picture: pixels from the upper left corner, and the distance along the view axis.
struct PixelPoint {
  double x = 0.0, y = 0.0;  ///< px; the centre of the first pixel is (0.5, 0.5)
  double depth = 0.0;       ///< m along the view axis; negative behind the eye
};

/// A pinhole camera that looks from `eye` to `target`. World frame, Z up, m and rad.
struct Camera {
  Vec3 eye{2.0, -2.0, 1.5};
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3::UnitZ();
  double field_of_view = 0.7;  ///< vertical, rad, in (0, pi)
  double near_plane = 0.01;    ///< m
  double far_plane = 100.0;    ///< m

  /// World to camera: x right, y up, looking along -z.
  Mat4 view() const;
  /// Camera to clip space, OpenGL's convention (z in -w .. w).
  Mat4 projection(double aspect) const;

  /// Where a world point lies in a picture of that size.
  PixelPoint project(const Vec3& p_W, int width, int height) const;
  /// The ray through a pixel position.
  geometry::Ray unproject(double x, double y, int width, int height) const;

  /// Pixels that a length of 1 m across the view axis covers at 1 m depth.
  double focal_length(int height) const;
};

/// A sensible view of a box: from the front right and above (`azimuth` about Z, 0 looks from +X,
/// -pi/2 from the front, -Y; `elevation` above the horizon; rad), as near as its corners allow with
/// a margin of 8 %, in a picture of that aspect ratio. An empty box is taken as the unit cube.
Camera frame(const Eigen::AlignedBox3d& bounds, double aspect = 16.0 / 9.0, double azimuth = -1.0,
             double elevation = 0.3);

/// Throws UsageError where eye and target coincide, the field of view is not in (0, pi) or the
/// planes are not 0 < near < far.
void check(const Camera& camera);

}  // namespace pedicel::render
