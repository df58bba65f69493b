// The rotation vector: exp and log are inverse, and the Jacobian is log's derivative.
#include "plugins/cosserat/model/rotation.h"

#include <gtest/gtest.h>

#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

// Sizes on both sides of every switch to a series (1e-3), and near pi.
constexpr double sizes[] = {0.0, 1e-12, 1e-5, 0.9e-3, 1.1e-3, 0.0099, 0.0101, 0.5, 2.0, 3.1};

TEST(Rotation, LogIsTheInverseOfExp) {
  Random random(1);
  for (const double size : sizes) {
    const Vec3 phi = size * random_vector(random).normalized();
    const Quat q = exp_map(phi);
    EXPECT_NEAR(q.norm(), 1.0, 1e-14);
    EXPECT_LT((log_map(q) - phi).norm(), 1e-13 * (1.0 + size));
    const Quat other_sign(-q.coeffs());
    EXPECT_LT((log_map(other_sign) - phi).norm(), 1e-13 * (1.0 + size));
    const Quat exact(Eigen::AngleAxisd(size, size > 0.0 ? Vec3(phi / size) : Vec3::UnitX()));
    EXPECT_LT((q.coeffs() - exact.coeffs()).norm(), 1e-14);
  }
}

// Central differences with step 1e-6: truncation 1e-12, rounding 1e-10, larger near pi where the
// third derivative grows.
TEST(Rotation, JacobianIsTheDerivativeOfLog) {
  Random random(2);
  constexpr double step = 1e-6;
  for (const double size : sizes) {
    const Vec3 phi = size * random_vector(random).normalized();
    const Mat3 jacobian = inverse_right_jacobian(phi);
    for (int i = 0; i < 3; ++i) {
      const Vec3 turn = step * Vec3::Unit(i);
      const Vec3 slope =
          (log_map(exp_map(phi) * exp_map(turn)) - log_map(exp_map(phi) * exp_map(-turn))) /
          (2 * step);
      EXPECT_LT((jacobian.col(i) - slope).norm(), 1e-8) << size;
    }
  }
}

TEST(Rotation, LeastRotationTurnsOneOntoTheOther) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vec3 a = random_vector(random).normalized(), b = random_vector(random).normalized();
    const Quat q = least_rotation(a, b);
    EXPECT_LT((q * a - b).norm(), 1e-12);
    EXPECT_NEAR(log_map(q).norm(), std::acos(a.dot(b)), 1e-9);
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
