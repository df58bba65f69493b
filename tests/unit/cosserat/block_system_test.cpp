// The block factorisation against a dense solution of the same system.
#include "plugins/cosserat/solver/block_system.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "tests/unit/cosserat/loop_graphs.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

Mat6 random_block(Random& random) {
  Mat6 block;
  for (int i = 0; i < 36; ++i) block.data()[i] = random.uniform(-1.0, 1.0);
  return block;
}

// Fills a system with a random symmetric, diagonally dominant matrix and a random right side.
void fill(const RodModel& model, Random& random, BlockSystem& system) {
  for (int e = 0; e < model.size(); ++e) {
    const Mat6 half = random_block(random);
    system.diagonal(e) = half * half.transpose() + 40.0 * Mat6::Identity();
    for (int i = 0; i < 6; ++i) system.right_side(e)[i] = random.uniform(-1, 1);
    if (model.elements[e].parent >= 0) system.coupling(e) = random_block(random);
  }
  for (int w = 0; w < static_cast<int>(model.welds.size()); ++w)
    system.weld(w) = random_block(random);
}

// The same system as one matrix and one right side.
struct Dense {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};
Dense dense_of(const RodModel& model, BlockSystem& system) {
  const int n = 6 * model.size();
  Dense dense{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd(n)};
  const auto couple = [&](int row, int column, const Mat6& block) {
    dense.matrix.block<6, 6>(6 * row, 6 * column) += block;
    dense.matrix.block<6, 6>(6 * column, 6 * row) += block.transpose();
  };
  for (int e = 0; e < model.size(); ++e) {
    dense.matrix.block<6, 6>(6 * e, 6 * e) = system.diagonal(e);
    dense.right.segment<6>(6 * e) = system.right_side(e);
    if (model.elements[e].parent >= 0) couple(e, model.elements[e].parent, system.coupling(e));
  }
  for (int w = 0; w < static_cast<int>(model.welds.size()); ++w)
    couple(model.welds[w].b, model.welds[w].a, system.weld(w));
  return dense;
}

// The matrix is dominated by its diagonal, so it is well conditioned: what is left is rounding of a
// few hundred terms of order one.
void expect_solved_like_dense(const RodModel& model, BlockSystem& system) {
  const Dense dense = dense_of(model, system);
  const Eigen::VectorXd expected = dense.matrix.ldlt().solve(dense.right);
  ASSERT_TRUE(system.solve());
  for (int e = 0; e < model.size(); ++e)
    EXPECT_LT((system.solution(e) - expected.segment<6>(6 * e)).norm(), 1e-12) << e;
}

TEST(BlockSystem, SolvesLikeADenseFactorisation) {
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const RodModel model = random_graph(random, 25, seed % 3 == 0 ? 0 : random.integer(1, 12));
    BlockSystem system(model);
    for (int again = 0; again < 2; ++again) {
      system.clear();
      fill(model, random, system);
      expect_solved_like_dense(model, system);
    }
  }
}

// What came off leaves an identity on the diagonal and nothing beside it: the same symbolic phase
// then solves what is left.
TEST(BlockSystem, LastsThroughAFracture) {
  Random random(5);
  const RodModel model = random_graph(random, 25, 10);
  const int gone = model.welds[0].b;
  BlockSystem system(model);
  fill(model, random, system);
  system.diagonal(gone).setIdentity();
  system.weld(1).setZero();  // a weld that tears
  for (int e = 0; e < model.size(); ++e)
    if (e == gone || model.elements[e].parent == gone) system.coupling(e).setZero();
  for (int w = 0; w < static_cast<int>(model.welds.size()); ++w)
    if (model.welds[w].a == gone || model.welds[w].b == gone) system.weld(w).setZero();
  const Vec6 right = system.right_side(gone);
  expect_solved_like_dense(model, system);
  EXPECT_EQ(system.solution(gone), right);
}

// The signs of the eigenvalues of the dense twin; its own blocks stay as they were.
TEST(BlockSystem, CountsNegativeEigenvalues) {
  int most = 0;
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    const RodModel model = random_graph(random, 12, seed % 3 == 0 ? 0 : random.integer(1, 6));
    BlockSystem system(model);
    fill(model, random, system);
    for (int bad = random.integer(0, 5); bad > 0; --bad) {
      const int k = random.integer(0, 5);
      system.diagonal(random.integer(0, 11))(k, k) = random.uniform(-100.0, 0.0);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense_of(model, system).matrix);
    const auto negative = static_cast<int>((eigen.eigenvalues().array() < 0.0).count());
    EXPECT_EQ(system.negative_eigenvalues(), negative) << "seed " << seed;
    EXPECT_EQ(system.negative_eigenvalues(), negative) << "seed " << seed << ", again";
    EXPECT_EQ(system.solve(), negative == 0) << "seed " << seed;
    most = std::max(most, negative);
  }
  EXPECT_GT(most, 2);
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
