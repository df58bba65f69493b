// Standing as drawn: the drawn shape carries no net force on any element.
#include "cosserat/standing.h"

#include <gtest/gtest.h>

#include "cosserat/direct_solver.h"
#include "unit/cosserat/random_plants.h"
#include "unit/cosserat/step_potential.h"

namespace pedicel::cosserat::cases {
namespace {

const Vec3 gravity(0, 0, -9.81);

double largest_force(const RodModel& model) {
  const RodState state = drawn_state(model);
  StepPotential step(model);
  BlockSystem system(model);
  step.prepare(state, {1e3, gravity, {}, {}}, nullptr);  // inertia weighs nothing
  step.linearise(model, state, system);
  double largest = 0.0;
  for (int e = 0; e < model.size(); ++e) largest = std::max(largest, system.right_side(e).norm());
  return largest;
}

// Weights are 0.01 N to 0.1 N; what is left is rounding. (Some random plants are too limp to
// stand.)
TEST(Standing, DrawnShapeIsAnEquilibrium) {
  int standing = 0;
  for (int seed = 0; seed < 20; ++seed) {
    Random random(seed);
    RodModel model = random_plant(random, 10, false);
    EXPECT_GT(largest_force(model), 1e-3);
    if (!stand_as_drawn(model, gravity).solvable) continue;
    EXPECT_LT(largest_force(model), 1e-9) << "seed " << seed;
    ++standing;
  }
  EXPECT_GT(standing, 10);
}

TEST(Standing, WithASupportAndAWeldToo) {
  int standing = 0;
  for (int seed = 0; seed < 20; ++seed) {
    Random random(seed);
    RodModel model = random_plant(random, 10, true);
    if (!stand_as_drawn(model, gravity).solvable) continue;
    EXPECT_LT(largest_force(model), 1e-9) << "seed " << seed;
    ++standing;
  }
  EXPECT_GT(standing, 10);
}

// Statics of a beam on two supports: a stiff horizontal rod, clamped by nothing stiffer than
// itself, with an ideal hinge under its end, carries 3/8 of its weight there (Timoshenko, Strength
// of Materials, propped cantilever).
TEST(Standing, ProppedCantileverCarriesThreeEighths) {
  constexpr int n = 40;
  const Section section = circle_section(0.01, {1.0e9, 0.3, 600.0, 0.0});
  RodModel model;
  for (int e = 0; e < n; ++e) add_element(model, e - 1, Vec3(0.5 * (e + 1) / n, 0, 0), section);
  Support prop;
  prop.element = n - 1;
  prop.position_stiffness = 1.0e6;
  model.supports.push_back(prop);
  finish(model);
  stand_as_drawn(model, gravity);
  const double weight = section.mass * 0.5 * 9.81;
  const Vec3 reaction = model.supports[0].position_stiffness *
                        (model.supports[0].position - model.elements[n - 1].drawn_position);
  // n segments with bending at their joints: O(1/n^2), and shear, O((r/L)^2): 1e-3 each.
  EXPECT_NEAR(reaction.z() / weight, 3.0 / 8.0, 3e-3);
}

TEST(Standing, NamesTheJointThatWouldHaveToBendTooFar) {
  RodModel model;
  const Section limp = circle_section(0.0005, {1.0e6, 0.3, 600.0, 0.0});
  add_element(model, -1, Vec3(0.2, 0, 0), limp);
  model.fruits.push_back({"fruit", 0, 0.0, 0.03, 900.0, {}});
  finish(model);
  const Standing standing = stand_as_drawn(model, gravity);
  EXPECT_FALSE(standing.solvable);
  EXPECT_EQ(standing.element, 0);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
