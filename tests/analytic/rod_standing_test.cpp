// Standing as drawn: in a tree the forces and moments in every joint follow from the weights above
// it, so the rest shape that makes the drawn shape an equilibrium is exact. The reference is the
// drawn shape itself: no node may move by more than 1 um in 5 s (error accepted by the project;
// rounding alone gives about 1e-12 m).
#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "plugins/cosserat/solver/standing.h"
#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

// Random branches in random directions with fruits and masses, stiff enough not to topple.
RodModel random_tree(std::uint64_t seed) {
  Random random(seed);
  const Material material{2.0e8, 0.35, 700.0, 0.01};
  RodModel model;
  for (int e = 0; e < 40; ++e) {
    const int parent = e < 10 ? e - 1 : random.integer(0, e - 1);
    Vec3 step(random.normal(), random.normal(), random.normal());
    step = 0.03 * (step.normalized() + (e < 10 ? Vec3(0, 0, 4) : Vec3(0, 0, 1))).normalized();
    const Vec3 start = parent < 0 ? Vec3::Zero() : model.elements[parent].drawn_position;
    const double radius = e < 10 ? 0.005 : random.uniform(0.002, 0.003);
    const Section section = e % 3 == 0 ? ellipse_section(radius, 0.7 * radius, material)
                                       : circle_section(radius, material);
    add_element(model, parent, start + step, section);
    model.elements[e].damping_time = material.damping_time;
  }
  model.fruits.push_back({"fruit", 39, 0.0, 0.01, 900.0, {}});
  model.masses.push_back({20, 0.01, 0.005, 0.004});
  finish(model);
  return model;
}

double largest_move(const RodModel& model, const RodState& state) {
  double largest = 0.0;
  for (int e = 0; e < model.size(); ++e)
    largest = std::max(largest, (state.position[e] - model.elements[e].drawn_position).norm());
  return largest;
}

TEST(RodStanding, NoNodeOfARandomTreeMovesByAMicrometre) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    RodModel model = random_tree(seed);
    const Standing standing = stand_as_drawn(model, gravity);
    ASSERT_TRUE(standing.solvable);
    ASSERT_TRUE(is_stable(model, drawn_state(model), gravity)) << "seed " << seed;
    Simulation sim(model);
    double largest = 0.0;
    for (int i = 0; i < 5 * 240; ++i) {
      sim.step(1.0 / 240.0, gravity);
      largest = std::max(largest, largest_move(sim.model, sim.state));
    }
    EXPECT_LT(largest, 1e-6) << "seed " << seed;
  }
}

// The same tree without it sags by millimetres: the test above does not pass by stiffness alone.
TEST(RodStanding, WithoutItTheTreeSags) {
  const RodModel model = random_tree(1);
  RodState state = drawn_state(model);
  settle(model, state, gravity);
  EXPECT_GT(largest_move(model, state), 1e-4);
}

// It is an equilibrium, not a frozen shape: pushed aside and let go, the tree comes back.
TEST(RodStanding, ComesBackAfterAPush) {
  RodModel model = random_tree(1);
  stand_as_drawn(model, gravity);
  RodState state = drawn_state(model);
  const Load push{39, 0.0, Vec3(0.05, 0, 0), no_gravity};
  settle(model, state, gravity, {&push, 1});
  EXPECT_GT(largest_move(model, state), 1e-4);
  settle(model, state, gravity);
  EXPECT_LT(largest_move(model, state), 1e-7);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
