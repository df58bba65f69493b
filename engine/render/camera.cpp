#include "engine/render/camera.h"

#include <cmath>
#include <string>

#include "engine/core/check.h"

namespace pedicel::render {

namespace {

constexpr double margin = 1.08;  // room about a framed box

/// Rows: right, up, backwards.
Mat3 axes(const Camera& camera) {
  const Vec3 back = (camera.eye - camera.target).normalized();
  Vec3 right = camera.up.cross(back);
  // Looking along `up`: any horizontal will do, but always the same.
  if (right.norm() < 1e-6) right = Vec3::UnitY().cross(back);
  if (right.norm() < 1e-6) right = Vec3::UnitX();
  right.normalize();
  Mat3 rows;
  rows.row(0) = right;
  rows.row(1) = back.cross(right);
  rows.row(2) = back;
  return rows;
}

}  // namespace

Mat4 Camera::view() const {
  Mat4 matrix = Mat4::Identity();
  const Mat3 rotation = axes(*this);
  matrix.topLeftCorner<3, 3>() = rotation;
  matrix.topRightCorner<3, 1>() = -rotation * eye;
  return matrix;
}

Mat4 Camera::projection(double aspect) const {
  const double f = 1.0 / std::tan(0.5 * field_of_view);
  const double depth = near_plane - far_plane;
  Mat4 matrix = Mat4::Zero();
  matrix(0, 0) = f / aspect;
  matrix(1, 1) = f;
  matrix(2, 2) = (far_plane + near_plane) / depth;
  matrix(2, 3) = 2.0 * far_plane * near_plane / depth;
  matrix(3, 2) = -1.0;
  return matrix;
}

double Camera::focal_length(int height) const {
  return 0.5 * height / std::tan(0.5 * field_of_view);
}

PixelPoint Camera::project(const Vec3& p_W, int width, int height) const {
  const Vec3 p = axes(*this) * (p_W - eye);
  const double depth = -p.z();
  const double scale = focal_length(height) / depth;
  return {0.5 * width + scale * p.x(), 0.5 * height - scale * p.y(), depth};
}

geometry::Ray Camera::unproject(double x, double y, int width, int height) const {
  const double f = focal_length(height);
  const Vec3 p((x - 0.5 * width) / f, (0.5 * height - y) / f, -1.0);
  return {eye, (axes(*this).transpose() * p).normalized()};
}

Camera frame(const Eigen::AlignedBox3d& bounds, double aspect, double azimuth, double elevation) {
  Eigen::AlignedBox3d box = bounds;
  if (box.isEmpty()) box = {Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)};
  const Vec3 back(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                  std::sin(elevation));
  Camera camera;
  camera.target = box.center();
  camera.eye = camera.target + back;
  const Mat3 rows = axes(camera);
  const double up = std::tan(0.5 * camera.field_of_view);
  double distance = 0.05;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner =
        rows * (box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)) - camera.target);
    const double needed = std::max(std::abs(corner.x()) / aspect, std::abs(corner.y())) / up;
    distance = std::max(distance, margin * needed + corner.z());
  }
  camera.eye = camera.target + distance * back;
  camera.near_plane = 0.02 * distance;
  camera.far_plane = 60.0 * distance;
  return camera;
}

void check(const Camera& camera) {
  if ((camera.eye - camera.target).norm() < 1e-9)
    throw UsageError("Camera.eye and Camera.target coincide: must be apart");
  if (!(camera.field_of_view > 0.0 && camera.field_of_view < 3.14159))
    throw UsageError("Camera.field_of_view = " + std::to_string(camera.field_of_view) +
                     " rad: must be between 0 and pi");
  if (!(camera.near_plane > 0.0 && camera.far_plane > camera.near_plane))
    throw UsageError("Camera.near_plane = " + std::to_string(camera.near_plane) +
                     " m: must be > 0 and below far_plane = " + std::to_string(camera.far_plane) +
                     " m");
}

}  // namespace pedicel::render
