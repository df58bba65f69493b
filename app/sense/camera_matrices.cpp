#include "app/sense/camera_matrices.h"

namespace pedicel::app {

CameraMatrices matrices_of(const render::Camera& camera, int width, int height) {
  CameraMatrices result;
  result.width = width, result.height = height;
  const double focal = camera.focal_length(height);
  result.intrinsic << focal, 0.0, 0.5 * width, 0.0, focal, 0.5 * height, 0.0, 0.0, 1.0;
  // From y up, looking along -z, to y down, looking along z.
  const Vec3 turned(1.0, -1.0, -1.0);
  result.extrinsic = camera.view();
  result.extrinsic.topRows<3>() = turned.asDiagonal() * result.extrinsic.topRows<3>().eval();
  const Mat3 to_world = result.extrinsic.topLeftCorner<3, 3>().transpose();
  result.pose = {camera.eye, Quat(to_world).normalized()};
  return result;
}

Vec3 CameraMatrices::project(const Vec3& p_W) const {
  const Vec3 p = extrinsic.topLeftCorner<3, 3>() * p_W + extrinsic.topRightCorner<3, 1>();
  const Vec3 q = intrinsic * p;
  return {q.x() / q.z(), q.y() / q.z(), p.z()};
}

Vec3 CameraMatrices::unproject(double u, double v, double depth) const {
  const Vec3 p((u - intrinsic(0, 2)) / intrinsic(0, 0), (v - intrinsic(1, 2)) / intrinsic(1, 1),
               1.0);
  return extrinsic.topLeftCorner<3, 3>().transpose() *
         (depth * p - extrinsic.topRightCorner<3, 1>());
}

}  // namespace pedicel::app
