// Every energy of a step: force = -dE/dx over random states, zero at rest, unchanged by rigid
// motion; and the Hessian where it is exact.
#include <gtest/gtest.h>

#include "tests/unit/cosserat/random_plants.h"
#include "tests/unit/cosserat/step_potential.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double dt = 1.0 / 240.0;
const Vec3 gravity(0.5, -1.0, -9.81);

struct Step {
  RodModel model;
  RodState start, state;
  std::vector<Load> loads;
  StepPotential step;
  BlockSystem system;

  Step(Random& random, bool loops, bool first_order)
      : model(random_plant(random, 8, loops)),
        start(random_state(model, random, 2e-3, 0.2)),
        state(start),
        step(model),
        system(model) {
    const RodHistory history = random_history(model, start, random, dt);
    for (int e = 0; e < model.size(); ++e) {
      state.position[e] += random_vector(random, 1e-3);
      state.orientation[e] = state.orientation[e] * exp_map(random_vector(random, 0.1));
    }
    loads.push_back({3, 0.01, random_vector(random, 0.2), random_vector(random, 0.01)});
    step.prepare(start, {dt, gravity, loads, {}}, first_order ? nullptr : &history);
  }
  double slope(int e, int unknown, double by) {
    return (step.potential(model, nudged(state, e, unknown, by)) -
            step.potential(model, nudged(state, e, unknown, -by))) /
           (2.0 * by);
  }
};

// Central differences of an energy of some joules in double: step 1e-6 leaves a relative 1e-6 of
// the largest force.
TEST(RodEnergy, ForceIsMinusTheSlopeOfThePotential) {
  for (int run = 0; run < 6; ++run) {
    Random random(100 + run);
    Step step(random, run % 2 == 1, run >= 3);
    step.step.linearise(step.model, step.state, step.system);
    double largest = 0.0, worst = 0.0;
    for (int e = 0; e < step.model.size(); ++e) {
      for (int i = 0; i < 6; ++i) {
        const double force = step.system.right_side(e)[i];
        largest = std::max(largest, std::abs(force));
        worst = std::max(worst, std::abs(force + step.slope(e, i, 1e-6)));
      }
    }
    EXPECT_LT(worst, 2e-6 * largest) << "run " << run;
  }
}

TEST(RodEnergy, LineariseAndPotentialAgree) {
  Random random(7);
  Step step(random, true, false);
  const double energy = step.step.linearise(step.model, step.state, step.system);
  EXPECT_NEAR(energy, step.step.potential(step.model, step.state), 1e-12 * std::abs(energy));
}

// Newton's matrix is positive definite however the plant is bent.
TEST(RodEnergy, HessianIsPositiveDefinite) {
  for (int run = 0; run < 20; ++run) {
    Random random(200 + run);
    const RodModel model = random_plant(random, 12, run % 2 == 1);
    const RodState state = random_state(model, random, 0.02, 1.5);
    const RodHistory history = random_history(model, state, random, dt);
    StepPotential step(model);
    BlockSystem system(model);
    step.prepare(state, {dt, gravity, {}, {}}, &history);
    step.linearise(model, state, system);
    EXPECT_EQ(system.negative_eigenvalues(), 0) << "run " << run;
    EXPECT_TRUE(system.solve()) << "run " << run;
  }
}

// At rest every residual is zero, and Gauss-Newton is the whole second derivative. (No weld: its
// two nodes do not coincide in a random plant.)
TEST(RodEnergy, HessianAtRestIsTheSlopeOfTheForce) {
  Random random(8);
  const RodModel model = random_plant(random, 6, true);
  const RodState rest = drawn_state(model);
  StepPotential potential(model);
  BlockSystem system(model), moved(model);
  potential.prepare(rest, {dt, Vec3::Zero(), {}, {}}, nullptr);
  potential.linearise(model, rest, system);
  constexpr double step = 1e-6;
  for (int e = 0; e < model.size(); ++e) {
    const double scale = system.diagonal(e).cwiseAbs().maxCoeff();
    const int p = model.elements[e].parent;
    for (int i = 0; i < 6; ++i) {
      potential.linearise(model, nudged(rest, e, i, step), moved);
      const Vec6 own = -moved.right_side(e) / step;
      EXPECT_LT((own - system.diagonal(e).col(i)).norm(), 1e-4 * scale) << e << " " << i;
      if (e == model.welds[0].b) {
        const Vec6 welded = -moved.right_side(model.welds[0].a) / step;
        const Vec6 other = system.weld(0).row(i).transpose();
        EXPECT_LT((welded - other).norm(), 1e-4 * scale) << e << " " << i;
      }
      if (p < 0) continue;
      const Vec6 parent = -moved.right_side(p) / step;
      const Vec6 expected = system.coupling(e).row(i).transpose();
      EXPECT_LT((parent - expected).norm(), 1e-4 * scale) << e << " " << i;
    }
  }
}

TEST(RodEnergy, ZeroAtRest) {
  Random random(9);
  const RodModel model = random_plant(random, 10, true);
  const RodState state = drawn_state(model);
  EXPECT_NEAR(energy_of(model, state, Vec3::Zero()).total(), 0.0, 1e-18);
  for (int e = 0; e < model.size(); ++e) {
    EXPECT_LT(joint_load(model, state, e).force.norm(), 1e-9);
    EXPECT_LT(joint_load(model, state, e).moment.norm(), 1e-12);
  }
}

TEST(RodEnergy, UnchangedByRigidMotion) {
  Random random(10);
  const RodModel model = random_plant(random, 10, false);
  const RodState state = random_state(model, random, 5e-3, 0.5);
  const Pose motion{random_vector(random), exp_map(random_vector(random, 2.0))};
  RodState moved = state;
  moved.root = motion * state.root;
  for (int e = 0; e < model.size(); ++e) {
    moved.position[e] = motion * state.position[e];
    moved.orientation[e] = motion.rotation * state.orientation[e];
    moved.velocity[e] = motion.rotation * state.velocity[e];
  }
  const Energy before = energy_of(model, state, Vec3::Zero());
  const Energy after = energy_of(model, moved, Vec3::Zero());
  EXPECT_NEAR(after.elastic / before.elastic, 1.0, 1e-11);
  EXPECT_NEAR(after.kinetic / before.kinetic, 1.0, 1e-12);
}

// The report's energy is the one that the solver works with: its slope is the joints' force.
TEST(RodEnergy, SlopeOfTheReportedEnergyIsTheJointsForce) {
  Random random(11);
  const RodModel model = random_plant(random, 1, false);  // one segment: no neighbours
  const RodState state = random_state(model, random, 2e-3, 0.3);
  constexpr double step = 1e-6;
  const Vec3 force = state.orientation[0] * joint_load(model, state, 0).force;
  for (int i = 0; i < 3; ++i) {
    const double slope = (energy_of(model, nudged(state, 0, i, step), Vec3::Zero()).elastic -
                          energy_of(model, nudged(state, 0, i, -step), Vec3::Zero()).elastic) /
                         (2 * step);
    EXPECT_NEAR(slope, force[i], 1e-5 * force.norm());
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
