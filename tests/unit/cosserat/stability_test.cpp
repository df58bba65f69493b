// is_stable against the eigenvalues of a Hessian made by differences of the energy itself.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "plugins/cosserat/solver/standing.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

// Second differences along the unknowns, turning each frame by one rotation vector.
Eigen::MatrixXd hessian(const RodModel& model, const RodState& state, const Vec3& gravity,
                        const Load& load) {
  constexpr double step = 1e-4;
  const int n = 6 * model.size();
  const auto energy = [&](int i, double a, int j, double b) {
    RodState moved = state;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(n);
    change[i] += a;
    change[j] += b;
    for (int e = 0; e < model.size(); ++e) {
      moved.position[e] += change.segment<3>(6 * e);
      moved.orientation[e] = exp_map(change.segment<3>(6 * e + 3)) * moved.orientation[e];
    }
    const Vec3 axis = moved.orientation[load.element] * Vec3::UnitZ();
    return energy_of(model, moved, gravity).total() -
           load.force_W.dot(moved.position[load.element] - load.back * axis);
  };
  Eigen::MatrixXd h(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j)
      h(i, j) = h(j, i) = (energy(i, step, j, step) - energy(i, step, j, -step) -
                           energy(i, -step, j, step) + energy(i, -step, j, -step)) /
                          (4 * step * step);
  return h;
}

TEST(Stability, AgreesWithTheHessianByDifferences) {
  int stable = 0, unstable = 0;
  for (int run = 0; run < 100; ++run) {
    Random random(run);
    RodModel model = random_plant(random, 4, false);
    const Vec3 gravity(0, 0, -20.0 * std::pow(10.0, random.uniform(0.0, 2.0)));
    if (!stand_as_drawn(model, gravity).solvable) continue;
    const Load load{3, 0.01, random_vector(random, 0.1), Vec3::Zero()};
    const RodState state = drawn_state(model);
    // Scaled by the diagonal, so that metres and radians weigh the same; signs are kept.
    Eigen::MatrixXd h = hessian(model, state, gravity, load);
    const Eigen::VectorXd scale = h.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    h = scale.asDiagonal() * h * scale.asDiagonal();
    const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(h).eigenvalues()[0];
    if (std::abs(lowest) < 1e-4) continue;  // what the differences cannot tell from zero
    EXPECT_EQ(is_stable(model, state, gravity, {&load, 1}), lowest > 0.0) << run << " " << lowest;
    ++(lowest > 0.0 ? stable : unstable);
  }
  EXPECT_GT(stable, 5);
  EXPECT_GT(unstable, 5);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
