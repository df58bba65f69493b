// The position-based solver: the same statics as the direct solver where its sweeps converge, and
// no overflow where they cannot.
#include <gtest/gtest.h>

#include <limits>

#include "tests/analytic/rod_cases.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

RodSettings sweeps(int iterations, int substeps = 1) {
  RodSettings settings;
  settings.solver = SolverKind::position_based;
  settings.iterations = iterations;
  settings.substeps = substeps;
  return settings;
}

bool all_finite(const RodState& state) {
  for (int e = 0; e < state.size(); ++e)
    if (!state.position[e].allFinite() || !state.orientation[e].coeffs().allFinite() ||
        !state.velocity[e].allFinite() || !state.angular_velocity[e].allFinite())
      return false;
  return true;
}

TEST(PositionBasedSolver, StaysInItsRestShape) {
  Random random(1);
  Simulation sim(random_plant(random, 12, false), sweeps(5));
  const RodState start = sim.state;
  for (int i = 0; i < 100; ++i) sim.step(1.0 / 240.0, no_gravity);
  for (int e = 0; e < sim.model.size(); ++e)
    EXPECT_LT((sim.state.position[e] - start.position[e]).norm(), 1e-10);
}

// Settles a plant with both solvers; returns the largest distance between the two, as a share of
// the largest move.
double difference(const RodModel& plant, const std::vector<Load>& loads) {
  RodModel model = plant;
  for (Element& element : model.elements) {
    element.damping_time = 0.01;
    element.mass_damping = 5.0;
  }
  RodState direct = drawn_state(model);
  settle(model, direct, gravity, loads);
  Simulation sim(model, sweeps(4, 40));
  sim.loads = loads;
  for (int i = 0; i < 3 * 120; ++i) sim.step(1.0 / 120.0, gravity);
  double apart = 0.0, moved = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    apart = std::max(apart, (sim.state.position[e] - direct.position[e]).norm());
    moved = std::max(moved, (direct.position[e] - model.elements[e].drawn_position).norm());
  }
  EXPECT_GT(moved, 1e-4);
  return apart / moved;
}

// Branches, masses, a fruit, loads between nodes; with a support and a weld too. 3 %: the share of
// the sweeps that small sub-steps still leave unconverged, and masses at nodes.
TEST(PositionBasedSolver, SmallStepsFindTheDirectSolversStatics) {
  for (const bool loops : {false, true}) {
    Random random(3);
    const RodModel model = random_plant(random, 6, loops);
    const Load load{4, 0.01, Vec3(0.02, 0.01, 0), Vec3(0, 0, 1e-3)};
    EXPECT_LT(difference(model, {load}), 0.03) << loops;
  }
}

// Stretched by a hanging weight: EA enters too. The exact stretch is W L / EA.
TEST(PositionBasedSolver, StretchUnderAWeight) {
  const Material rubber{1.0e6, 0.49, 1000.0, 0.0};
  RodModel model =
      straight_rod(0.2, 5, circle_section(0.003, rubber), -Vec3::UnitZ(), Vec3::Zero(), 0.02);
  Simulation sim(model, sweeps(20, 10));
  const double force = 0.5;
  sim.loads.push_back({4, 0.0, Vec3(0, 0, -force), no_gravity});
  for (int i = 0; i < 480; ++i) sim.step(1.0 / 240.0, no_gravity);
  const double stretch = -sim.tip().z() - 0.2;
  EXPECT_NEAR(stretch / (force * 0.2 / model.elements[0].section.axial), 1.0, 0.01);
}

// zeta = omega tau / 2 of the first mode, tau 0.02 s: 0.07. The sweeps neither hold the exact
// frequency nor is their own damping nought, so the extra damping is compared, to a third.
TEST(PositionBasedSolver, KelvinVoigtDampsTheSwing) {
  double ratio[2];
  for (int i = 0; i < 2; ++i) {
    RodModel model = PeerCantilever::model(5);
    for (Element& element : model.elements) element.damping_time = i == 0 ? 0.0 : 0.02;
    Simulation sim(model, sweeps(2, 40));
    set_mode_shape(sim.model, sim.state, CantileverMode(1, 0.4), 0.01, Vec3::UnitZ());
    Oscillation signal;
    while (signal.crossings() < 5 && sim.state.time < 5.0) {
      signal.add(sim.state.time, sim.tip().z());
      sim.step(1.0 / 120.0, no_gravity);
    }
    ratio[i] = signal.damping_ratio();
  }
  EXPECT_NEAR((ratio[1] - ratio[0]) / (0.5 * 2.0 * pi * 1.106 * 0.02), 1.0, 0.33);
}

// Absurd stiffness, mass ratios, steps and speeds: everything stays finite.
TEST(PositionBasedSolver, NeverOverflows) {
  for (int run = 0; run < 20; ++run) {
    Random random(run);
    RodModel model = random_plant(random, 15, run % 2 == 1);
    const double scale = std::pow(10.0, random.uniform(-8.0, 8.0));
    for (Element& element : model.elements) {
      element.bend_stiffness *= scale;
      element.stretch_stiffness *= scale;
    }
    Simulation sim(model, sweeps(5));
    for (Vec3& v : sim.state.velocity) v = random_vector(random, 1e3);
    for (Vec3& omega : sim.state.angular_velocity) omega = random_vector(random, 1e4);
    for (int i = 0; i < 100; ++i) sim.step(run % 3 == 0 ? 0.5 : 0.01, gravity);
    EXPECT_TRUE(all_finite(sim.state)) << run;
  }
}

TEST(PositionBasedSolver, AnInfiniteLoadPutsTheStateBackAndSaysSo) {
  Simulation sim(PeerCantilever::model(5), sweeps(5));
  sim.step(0.01, gravity);
  const RodState before = sim.state;
  sim.loads.push_back({4, 0.0, Vec3(std::numeric_limits<double>::infinity(), 0, 0), no_gravity});
  EXPECT_EQ(sim.step(0.01, gravity).errors, static_cast<unsigned>(not_finite));
  EXPECT_EQ(sim.state.position.back(), before.position.back());
  EXPECT_EQ(sim.state.time, before.time);
  sim.loads.clear();
  EXPECT_EQ(sim.step(0.01, gravity).errors, 0u);
}

TEST(PositionBasedSolver, LeavesElementsThatCameOffAlone) {
  Random random(5);
  Simulation sim(random_plant(random, 8, false), sweeps(5));
  sim.state.alive.back() = 0;
  const Vec3 place = sim.state.position.back();
  for (int i = 0; i < 50; ++i) sim.step(1.0 / 240.0, gravity);
  EXPECT_EQ(sim.state.position.back(), place);
  EXPECT_TRUE(all_finite(sim.state));
}

TEST(PositionBasedSolver, FollowsItsClamp) {
  Simulation sim(PeerCantilever::model(5), sweeps(20));
  const Vec3 start = sim.tip();
  for (int i = 0; i < 240; ++i) {
    sim.state.root.position.y() = 0.1 * (i + 1) / 240.0;
    sim.step(1.0 / 240.0, no_gravity);
  }
  EXPECT_NEAR(sim.state.root.position.y(), 0.1, 1e-12);
  EXPECT_NEAR((sim.tip() - start).y(), 0.1, 0.05);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
