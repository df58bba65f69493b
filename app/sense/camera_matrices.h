#pragma once

#include "engine/render/camera.h"

namespace pedicel::app {

/// A pinhole camera as matrices. Its frame has x to the right, y down and z forward. Pixels count
/// from the upper left corner of the picture: the middle of the first one is (0.5, 0.5).
struct CameraMatrices {
  int width = 0, height = 0;                          ///< px
  Mat3 intrinsic = Mat3::Identity();                  ///< px, camera frame to picture
  Pose pose;                                          ///< X_WC
  render::Mat4 extrinsic = render::Mat4::Identity();  ///< world to camera frame

  /// The place in the picture (px) and its depth (m) of a point of the world.
  Vec3 project(const Vec3& p_W) const;
  /// The point of the world (m) at a place in the picture (px) and a depth (m).
  Vec3 unproject(double u, double v, double depth) const;
};

CameraMatrices matrices_of(const render::Camera& camera, int width, int height);

}  // namespace pedicel::app
