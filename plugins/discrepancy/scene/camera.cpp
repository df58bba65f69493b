#include "plugins/discrepancy/scene/camera.h"

#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

constexpr double nearest = 1.0e-6;  // m in front of the pinhole
constexpr double undone = 1.0e-9;   // 1, far below a pixel
constexpr int undoing = 100;

// Brown's model, as OpenCV writes it: of a place on the plane at z = 1.
Eigen::Vector2d distorted(const Camera& camera, const Eigen::Vector2d& place) {
  const double x = place.x(), y = place.y();
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

}  // namespace

Eigen::Vector2d image_of(const Camera& camera, const Vec3& point_W) {
  const Vec3 p = camera.X_WC.rotation.conjugate() * (point_W - camera.X_WC.position);
  if (!(p.z() > nearest))
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return camera.focal.cwiseProduct(distorted(camera, {p.x() / p.z(), p.y() / p.z()})) +
         camera.centre;
}

Eigen::Vector2d direction_of(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d nowhere =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::Vector2d wanted = (pixel - camera.centre).cwiseQuotient(camera.focal);
  // Lenses distort little, so the place itself is near. Each turn leaves the error that the
  // distortion's slope makes of the last one.
  Eigen::Vector2d place = wanted;
  for (int i = 0; i < undoing; ++i) {
    const Eigen::Vector2d off = wanted - distorted(camera, place);
    // On the other side of the middle it is where a strong distortion folds the picture over.
    if (!off.allFinite()) return nowhere;
    if (off.norm() <= undone) return place.dot(wanted) >= 0.0 ? place : nowhere;
    place += off;
  }
  return nowhere;
}

Quat looking_at(const Vec3& eye, const Vec3& target) {
  const Vec3 forward = (target - eye).normalized();
  Vec3 right = forward.cross(Vec3::UnitZ());
  // Straight up or down the picture's right is the world's X.
  right = right.norm() > 1e-9 ? right.normalized() : Vec3::UnitX();
  Mat3 axes;
  axes << right, forward.cross(right), forward;
  return Quat(axes);
}

}  // namespace pedicel::discrepancy
