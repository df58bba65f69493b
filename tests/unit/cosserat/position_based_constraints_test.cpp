// The position-based constraints: gradients by differences, zero at rest, unchanged by rigid
// motion.
#include "plugins/cosserat/solver/position_based_constraints.h"

#include <gtest/gtest.h>

#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double step = 1e-6;

Quat random_rotation(Random& random, double size = 3.0) {
  return exp_map(random_vector(random, size / std::sqrt(3.0)));
}

TEST(PositionBasedConstraints, StretchShearGradients) {
  Random random(1);
  for (int run = 0; run < 20; ++run) {
    const Vec3 near = random_vector(random), far = random_vector(random);
    const Vec3 rest = random_vector(random, 0.1);
    const Quat q = random_rotation(random);
    const Mat3 by_turn = stretch_shear_by_rotation(near, far, q);
    const Mat3 by_far = q.toRotationMatrix().transpose();
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = step * Vec3::Unit(i);
      const auto value = [&](const Vec3& n, const Vec3& f, const Quat& r) {
        return stretch_shear(n, f, r, 0.3, rest);
      };
      const Vec3 turn =
          (value(near, far, q * exp_map(d)) - value(near, far, q * exp_map(-d))) / (2 * step);
      const Vec3 moved = (value(near, far + d, q) - value(near, far - d, q)) / (2 * step);
      const Vec3 pulled = (value(near + d, far, q) - value(near - d, far, q)) / (2 * step);
      EXPECT_LT((turn - by_turn.col(i)).norm(), 1e-8);
      EXPECT_LT((moved - by_far.col(i)).norm(), 1e-8);
      EXPECT_LT((pulled + by_far.col(i)).norm(), 1e-8);
    }
  }
}

// The paper's full four-part C_b has a gradient G with G^T G = 1 at any bend and rest rotation, and
// its projection G^T C is what the solver works with.
TEST(PositionBasedConstraints, BendTwistInFullHasAnIsometricGradient) {
  Random random(2);
  for (int run = 0; run < 50; ++run) {
    const Quat parent = random_rotation(random), rest = random_rotation(random);
    Quat q = parent * rest * random_rotation(random, 2.5);
    if (run % 2 == 1) q.coeffs() *= -1.0;  // the same rotation
    Eigen::Matrix<double, 4, 3> gradient;
    for (int i = 0; i < 3; ++i) {
      const Quat turn = exp_map(step * Vec3::Unit(i));
      gradient.col(i) = (bend_twist_in_full(parent, q * turn, rest) -
                         bend_twist_in_full(parent, q * turn.conjugate(), rest)) /
                        (2 * step);
    }
    const Vec3 projected = gradient.transpose() * bend_twist_in_full(parent, q, rest);
    EXPECT_LT((gradient.transpose() * gradient - Mat3::Identity()).norm(), 1e-8);
    EXPECT_LT((projected - bend_twist(parent, q, rest)).norm(), 1e-8);
  }
}

// The vector part of Omega - s Omega0 alone loses stiffness with the rest angle (6 % where 57
// degrees are turned); in full nothing is lost.
TEST(PositionBasedConstraints, RestAngleDoesNotSoften) {
  const double angle = 1e-4;
  for (const double rest_angle : {0.0, 0.5, 1.0, 2.0}) {
    const Quat rest = exp_map(Vec3(0, rest_angle, 0));
    const Quat q = rest * exp_map(Vec3(0, angle, 0));
    EXPECT_NEAR(bend_twist(Quat::Identity(), q, rest).norm() / angle, 1.0, 1e-7);
    EXPECT_NEAR(bend_twist_in_full(Quat::Identity(), q, rest).norm() / angle, 1.0, 1e-7);
    const double vector_part =
        bend_twist_in_full(Quat::Identity(), q, rest).head<3>().norm() / angle;
    EXPECT_NEAR(vector_part, std::cos(rest_angle / 2.0), 1e-3);
  }
}

TEST(PositionBasedConstraints, ZeroAtRestAndUnchangedByRigidMotion) {
  Random random(3);
  const Quat parent = random_rotation(random), rest = random_rotation(random);
  const Quat q = parent * rest;
  const Vec3 near = random_vector(random), far = near + 0.2 * (q * Vec3::UnitZ());
  EXPECT_LT(bend_twist(parent, q, rest).norm(), 1e-14);
  EXPECT_LT(bend_twist_in_full(parent, q, rest).norm(), 1e-14);
  EXPECT_LT(stretch_shear(near, far, q, 0.2, Vec3::Zero()).norm(), 1e-14);

  const Pose motion{random_vector(random), random_rotation(random)};
  const Quat bent = q * exp_map(Vec3(0.3, -0.2, 0.1));
  EXPECT_LT((bend_twist(parent, bent, rest) -
             bend_twist(motion.rotation * parent, motion.rotation * bent, rest))
                .norm(),
            1e-14);
  EXPECT_LT((stretch_shear(near, far, bent, 0.1, Vec3::Zero()) -
             stretch_shear(motion * near, motion * far, motion.rotation * bent, 0.1, Vec3::Zero()))
                .norm(),
            1e-14);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
