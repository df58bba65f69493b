// The O(n) elimination against a dense solution of the same system.
#include "cosserat/block_system.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

Mat6 random_block(Random& random) {
  Mat6 block;
  for (int i = 0; i < 36; ++i) block.data()[i] = random.uniform(-1.0, 1.0);
  return block;
}

// Fills a system with a random symmetric, diagonally dominant matrix, and returns its dense twin.
Eigen::MatrixXd fill(const RodModel& model, Random& random, BlockSystem& system,
                     Eigen::VectorXd& right) {
  const int n = model.size();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  right.resize(6 * n);
  const auto couple = [&](int row, int column, const Mat6& block) {
    dense.block<6, 6>(6 * row, 6 * column) += block;
    dense.block<6, 6>(6 * column, 6 * row) += block.transpose();
  };
  for (int e = 0; e < n; ++e) {
    const Mat6 half = random_block(random);
    system.diagonal(e) = half * half.transpose() + 40.0 * Mat6::Identity();
    dense.block<6, 6>(6 * e, 6 * e) = system.diagonal(e);
    for (int i = 0; i < 6; ++i) right[6 * e + i] = system.right_side(e)[i] = random.uniform(-1, 1);
    if (model.elements[e].parent < 0) continue;
    system.coupling(e) = random_block(random);
    couple(e, model.elements[e].parent, system.coupling(e));
  }
  for (int w = 0; w < static_cast<int>(model.welds.size()); ++w) {
    system.weld(w) = random_block(random);
    couple(model.welds[w].b, model.welds[w].a, system.weld(w));
  }
  return dense;
}

TEST(BlockSystem, SolvesLikeADenseFactorisation) {
  for (const bool loops : {false, true}) {
    Random random(loops ? 2 : 1);
    const RodModel model = random_plant(random, 15, loops);
    BlockSystem system(model);
    Eigen::VectorXd right;
    const Eigen::MatrixXd dense = fill(model, random, system, right);
    const Eigen::VectorXd expected = dense.ldlt().solve(right);
    ASSERT_TRUE(system.solve());
    for (int e = 0; e < model.size(); ++e)
      EXPECT_LT((system.solution(e) - expected.segment<6>(6 * e)).norm(), 1e-12) << e;
  }
}

TEST(BlockSystem, SaysWhereItIsNotPositiveDefinite) {
  for (const bool loops : {false, true}) {
    Random random(3);
    const RodModel model = random_plant(random, 10, loops);
    BlockSystem system(model);
    Eigen::VectorXd right;
    fill(model, random, system, right);
    EXPECT_EQ(system.negative_eigenvalues(), 0);
    for (const int e : {2, 7}) system.diagonal(e)(0, 0) = -100.0;
    EXPECT_EQ(system.negative_eigenvalues(), 2);
    EXPECT_FALSE(system.solve());
  }
}

// 1/2 x^T H x of a spring on a point at an arm, by its definition.
TEST(BlockSystem, PointSpring) {
  Random random(4);
  const RodModel model = random_plant(random, 1, false);
  BlockSystem system(model);
  const Vec3 arm = random_vector(random), force = random_vector(random);
  add_point_spring(system, 0, arm, 7.0 * Mat3::Identity(), force);
  Eigen::Matrix<double, 3, 6> by_unknown;
  by_unknown << Mat3::Identity(), -skew(arm);
  EXPECT_LT((system.diagonal(0) - 7.0 * by_unknown.transpose() * by_unknown).norm(), 1e-12);
  EXPECT_LT((system.right_side(0) - by_unknown.transpose() * force).norm(), 1e-12);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
