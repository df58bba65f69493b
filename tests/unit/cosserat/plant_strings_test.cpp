// Strings between plants: both ends feel one force, which is what the string says that it pulls
// with; slack they are as if they were not there; the bits do not depend on threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "engine/core/check.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/plant/reference_plants.h"
#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double string_dt = 1.0 / 240.0;

RodSettings exactly() {
  RodSettings settings;
  settings.newton_iterations = 60;
  settings.tolerance = 1.0e-11;
  return settings;
}

// Forest plants in a row, half a metre apart.
struct Row : RodSystem {
  explicit Row(int plants, const RodSettings& settings, int threads = 1)
      : RodSystem(settings, threads) {
    for (int p = 0; p < plants; ++p) {
      RodModel model = plant::forest_plant(p);
      const Vec3 by(0.5 * p, 0, 0);
      model.root.position += by;
      for (Element& element : model.elements) element.drawn_position += by;
      add_plant(std::move(model));
    }
  }
};

PlantString between(const RodSystem& system, PlantString::End a, PlantString::End b,
                    double stretched, double stiffness) {
  const double way = (*place_of(system, b) - *place_of(system, a)).norm();
  return {a, b, way - stretched, stiffness};
}

// What the strings say that they pull with, put on both ends as loads, makes the same step: so both
// ends are pulled along the string, by one force, and by nothing else. What a step leaves is of the
// order of its tolerance, and so is the difference. Each step begins anew from where the strings
// brought the plants, since a load that does not give way drives small errors apart; backward Euler
// needs no other past.
TEST(PlantStrings, PullBothEndsWithTheForceTheySay) {
  RodSettings settings = exactly();
  settings.integrator = Integrator::backward_euler;
  Row tied(3, settings), pulled(3, settings);
  tied.add_string(between(tied, {0, 15, 0.004}, {1, 14, 0.0}, 1.0e-4, 400.0));
  tied.add_string(between(tied, {1, 15, 0.0}, {2, 9, 0.01}, 1.0e-6, 3.0e4));
  tied.add_string(between(tied, {0, 9, 0.0}, {2, 16, 0.0}, 5.0e-4, 50.0));  // closes a loop
  // They are pulled apart, gently: what moves by centimetres in a step has more than one end.
  const std::array<Load, 3> apart = {Load{15, 0.0, Vec3(-0.01, 0.004, 0), Vec3::Zero()},
                                     Load{15, 0.0, Vec3(0, -0.006, 0), Vec3::Zero()},
                                     Load{15, 0.0, Vec3(0.01, 0, 0), Vec3::Zero()}};
  for (int p = 0; p < 3; ++p) tied.loads(p).push_back(apart[p]);
  double most = 0.0, moved = 0.0, off = 0.0;
  for (int i = 0; i < 60; ++i) {
    for (int p = 0; p < 3; ++p) {
      pulled.set_state(p, tied.state(p));
      pulled.loads(p).assign(1, apart[p]);
    }
    tied.step(string_dt, gravity);
    for (const PlantString& string : tied.strings()) {
      const Vec3 way = *place_of(tied, string.b) - *place_of(tied, string.a);
      const Vec3 force = tension(tied, string) * way.normalized();
      most = std::max(most, force.norm());
      pulled.loads(string.a.plant)
          .push_back({string.a.element, string.a.back, force, Vec3::Zero()});
      pulled.loads(string.b.plant)
          .push_back({string.b.element, string.b.back, -force, Vec3::Zero()});
    }
    std::vector<RodState> before;
    for (int p = 0; p < 3; ++p) before.push_back(pulled.state(p));
    pulled.step(string_dt, gravity);
    for (int p = 0; p < 3; ++p)
      for (int e = 0; e < tied.model(p).size(); ++e) {
        off = std::max(off, (tied.state(p).position[e] - pulled.state(p).position[e]).norm());
        moved = std::max(moved, (before[p].position[e] - pulled.state(p).position[e]).norm());
      }
  }
  EXPECT_GT(most, 0.01);
  EXPECT_GT(moved, 1e-4);
  EXPECT_LT(off, 1e-9);
}

// Two cantilevers side by side, drawn together at their ends by a string that is too short by d:
// T = d / (1/k + 2/K), with K = 3 E I / L^3 (Gere & Timoshenko, appendix G). However stiff it is,
// the ends come to rest there.
TEST(PlantStrings, ShareAStretchAsSpringsInARow) {
  constexpr double spring = 3.0 * PeerCantilever::bending / (0.4 * 0.4 * 0.4), short_by = 0.004;
  for (const double ratio : {0.5, 20.0, 1.0e5}) {
    RodSystem system(exactly());
    for (int p = 0; p < 2; ++p) {
      RodModel model = PeerCantilever::model(20);
      const Vec3 by(0, 0, 0.3 * p);
      model.root.position += by;
      for (Element& element : model.elements) element.drawn_position += by;
      for (Element& element : model.elements) element.mass_damping = 10.0;
      system.add_plant(std::move(model));
    }
    const double stiffness = ratio * spring;
    system.add_string(between(system, {0, 19, 0.0}, {1, 19, 0.0}, short_by, stiffness));
    for (int i = 0; i < 1500; ++i) system.step(string_dt, no_gravity);
    const double expected = short_by / (1.0 / stiffness + 2.0 / spring);
    EXPECT_NEAR(tension(system, system.strings()[0]), expected, 0.02 * expected) << ratio;
    EXPECT_NEAR(system.state(0).position[19].z(), 0.3 - system.state(1).position[19].z(), 1e-8);
  }
}

TEST(PlantStrings, SlackTheyAreNotThere) {
  Row tied(2, exactly()), free(2, exactly());
  tied.add_string(between(tied, {0, 15, 0.0}, {1, 15, 0.0}, -0.3, 1.0e4));
  for (Row* system : {&tied, &free})
    system->loads(0).push_back({15, 0.0, Vec3(0.05, 0.02, 0), Vec3::Zero()});
  for (int i = 0; i < 60; ++i) {
    tied.step(string_dt, gravity);
    free.step(string_dt, gravity);
    ASSERT_EQ(tension(tied, tied.strings()[0]), 0.0);
  }
  for (int p = 0; p < 2; ++p)
    for (int e = 0; e < tied.model(p).size(); ++e)
      EXPECT_LT((tied.state(p).position[e] - free.state(p).position[e]).norm(), 1e-8);
}

std::uint64_t net(int threads, bool touching) {
  Row system(5, RodSettings{}, threads);
  for (int p = 0; p + 1 < 5; ++p)
    system.add_string(between(system, {p, 15, 0.0}, {p + 1, 13, 0.0}, 0.05, 1.0e3));
  if (touching) system.let_plants_touch(SelfContactSettings{});
  double most = 0.0;  // at one time or another: they swing, and a string goes slack in between
  for (int i = 0; i < 120; ++i) {
    system.step(string_dt, gravity);
    most = std::max(most, tension(system, system.strings()[2]));
  }
  EXPECT_GT(most, 0.0);
  StateHash hash;
  system.add_to(hash);
  return hash.value();
}

TEST(PlantStrings, BitsDoNotDependOnThreads) {
  EXPECT_EQ(net(1, false), net(2, false));
  EXPECT_EQ(net(1, true), net(2, true));
}

// A plant that finds its contact with itself goes on doing so.
TEST(PlantStrings, APlantStillTouchesItself) {
  Row system(2, RodSettings{});
  for (int p = 0; p < 2; ++p)
    system.add_contact_source(
        p, std::make_unique<SelfContact>(system.model(p), SelfContactSettings{}));
  system.add_string(between(system, {0, 15, 0.0}, {1, 15, 0.0}, 0.01, 100.0));
  // Two tips of a plant that are pressed through each other.
  const Vec3 way = *place_of(system, {1, 9, 0.0}) - *place_of(system, {1, 15, 0.0});
  system.loads(1).push_back({15, 0.0, 2.0 * way.normalized(), Vec3::Zero()});
  system.loads(1).push_back({9, 0.0, -2.0 * way.normalized(), Vec3::Zero()});
  int touched = 0;
  for (int i = 0; i < 240; ++i) {
    system.step(string_dt, gravity);
    for (const ContactForce& force : system.contact_forces(1)) {
      ++touched;
      ASSERT_TRUE(is_self_contact(force.point.collider));
      ASSERT_FALSE(is_other_plant(force.point.collider));
      ASSERT_LT(force.point.collider - self_contact_base,
                static_cast<int>(system.model(1).shapes.size()));
    }
  }
  EXPECT_GT(touched, 0);
}

TEST(PlantStrings, WhatCannotBeTiedIsRefused) {
  Row system(2, RodSettings{});
  const auto refusal = [&](const PlantString& string) -> std::string {
    try {
      system.add_string(string);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({{0, 3, 0.0}, {0, 3, 0.001}, 0.1, 1.0}),
              testing::HasSubstr("on one element"));
  EXPECT_THAT(refusal({{0, 3, 0.0}, {2, 3, 0.0}, 0.1, 1.0}), testing::HasSubstr("no element"));
  RodSettings paper;
  paper.solver = SolverKind::position_based;
  Row other(2, paper);
  EXPECT_THROW(other.add_string({{0, 3, 0.0}, {1, 3, 0.0}, 0.1, 1.0}), UsageError);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
