#include "pedicel/discrepancy/scene/camera.h"

#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {
constexpr double nearest = 1.0e-6;  // m in front of the pinhole
}

Eigen::Vector2d image_of(const Camera& camera, const Vec3& point_W) {
  const Vec3 p = camera.X_WC.rotation.conjugate() * (point_W - camera.X_WC.position);
  if (!(p.z() > nearest))
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const double x = p.x() / p.z(), y = p.y() / p.z();
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  // Brown's model, as OpenCV writes it.
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
  const double yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
  return camera.focal.cwiseProduct(Eigen::Vector2d(xd, yd)) + camera.centre;
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
