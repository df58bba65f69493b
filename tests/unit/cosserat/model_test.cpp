// What is computed once of a plant: frames, stiffness of joints, inertia.
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::cosserat::cases {
namespace {

const Material material{2.0e7, 0.3, 600.0, 0.0};

TEST(RodModel, FramesFollowTheSegments) {
  Random random(1);
  const RodModel model = random_plant(random, 20, false);
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    const Vec3 along = (element.drawn_position - model.drawn_start(e)) / element.length;
    EXPECT_LT((element.drawn_rotation * Vec3::UnitZ() - along).norm(), 1e-12);
  }
}

TEST(RodModel, FirstAxisComesFromTheNormal) {
  RodModel model;
  add_element(model, -1, Vec3(0.1, 0, 0), rectangle_section(0.03, 0.01, material), Vec3(5, 0, 2));
  EXPECT_LT((model.elements[0].drawn_rotation * Vec3::UnitX() - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(RodModel, ASegmentWithoutLengthIsRefused) {
  RodModel model;
  try {
    add_element(model, -1, Vec3::Zero(), circle_section(0.01, material));
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "a segment's length = 0 m: must be > 0");
  }
}

// Compliances add: half of each segment, and half of the first one at the clamp. For a rod of
// segments of one section that is l/(2EI), then l/EI.
TEST(RodModel, JointComplianceIsHalfOfEachSegment) {
  const Section thick = circle_section(0.004, material), thin = circle_section(0.002, material);
  RodModel model;
  add_element(model, -1, Vec3(0, 0, 0.03), thick);
  add_element(model, 0, Vec3(0, 0, 0.05), thin);
  add_element(model, 0, Vec3(0.04, 0, 0.03), thin);
  finish(model);
  EXPECT_NEAR(model.elements[0].bend_stiffness.x(), 2 * thick.bend1 / 0.03, 1e-9);
  EXPECT_NEAR(1 / model.elements[1].bend_stiffness.x(), 0.015 / thick.bend1 + 0.01 / thin.bend1,
              1e-9);
  EXPECT_NEAR(1 / model.elements[2].bend_stiffness.z(), 0.015 / thick.twist + 0.02 / thin.twist,
              1e-9);
}

// Mass, centre and inertia against a sum over many small bodies.
TEST(RodModel, InertiaOfASegmentWithAFruitAndAMass) {
  const double radius = 0.004, length = 0.05;
  RodModel model;
  add_element(model, -1, Vec3(0, 0, length), circle_section(radius, material));
  model.masses.push_back({0, 0.02, 0.004, 0.003});
  model.fruits.push_back({"fruit", 0, -0.005, 0.01, 900.0, {}});
  finish(model);
  const double fruit = 900.0 * 4.0 / 3.0 * 3.14159265358979 * 1e-6;
  EXPECT_NEAR(fruit_mass(model.fruits[0]), fruit, 1e-12);

  constexpr int slices = 20000;
  const double slice = model.elements[0].section.mass * length / slices;
  double mass = fruit + 0.004, moment = 0.02 * 0.004 - 0.005 * fruit;
  for (int i = 0; i < slices; ++i) {
    mass += slice;
    moment += slice * length * (i + 0.5) / slices;
  }
  const double com = moment / mass;
  const double spheres = 0.4 * fruit * 1e-4 + 0.4 * 0.004 * 9e-6;
  double across = spheres + fruit * std::pow(-0.005 - com, 2) + 0.004 * std::pow(0.02 - com, 2);
  for (int i = 0; i < slices; ++i)
    across += slice * (radius * radius / 4 + std::pow(length * (i + 0.5) / slices - com, 2));
  const Element& element = model.elements[0];
  EXPECT_NEAR(element.mass, mass, 1e-12);
  EXPECT_NEAR(element.com_back, com, 1e-12);
  EXPECT_NEAR(element.inertia.x() / across, 1.0, 1e-7);  // slices: 1/slices^2
  EXPECT_NEAR(element.inertia.z(), spheres + slices * slice * radius * radius / 2, 1e-15);

  lump_inertia(model, 0, {true});
  EXPECT_NEAR(model.elements[0].mass, mass - fruit, 1e-12);
}

TEST(RodModel, OneShapeASegmentAndOneAFruit) {
  Random random(2);
  const RodModel model = random_plant(random, 7, false);
  ASSERT_EQ(model.shapes.size(), 8u);
  EXPECT_EQ(model.shapes[3].element, 3);
  EXPECT_EQ(model.shapes[3].fruit, -1);
  EXPECT_EQ(model.shapes[7].fruit, 0);
  EXPECT_DOUBLE_EQ(model.shapes[7].radius_far, model.fruits[0].radius);
}

// The field of velocities of a rigid segment, from the positions it has a moment later.
TEST(RodState, VelocityOfAPlace) {
  Random random(3);
  const RodModel model = random_plant(random, 5, false);
  const RodState state = random_state(model, random, 0.0, 0.0);
  constexpr double dt = 1e-6;
  for (int e = 0; e < model.size(); ++e) {
    const double back = 0.3 * model.elements[e].length, com = model.elements[e].com_back;
    const auto place = [&](double time) {
      const Quat q = state.orientation[e] * exp_map(time * state.angular_velocity[e]);
      const Vec3 centre =
          state.position[e] - state.orientation[e] * Vec3(0, 0, com) + time * state.velocity[e];
      return Vec3(centre + q * Vec3(0, 0, com - back));
    };
    EXPECT_LT((place(0.0) - point_on(model, state, e, back)).norm(), 1e-12);
    EXPECT_LT(((place(dt) - place(-dt)) / (2 * dt) - velocity_on(model, state, e, back)).norm(),
              1e-8);
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
