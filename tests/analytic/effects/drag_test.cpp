// Drag and wind. A rigid segment of length l on its joint, its middle at l/2: with the velocity of
// the air normal to it U cos(phi), I phi'' = -K phi + l/2 c |u| u, u = U cos(phi) - l/2 phi',
// c = 1/2 rho drag_area l (the air moves along -z, phi counts towards -z).
#include <gtest/gtest.h>

#include "tests/analytic/effects/joint_cases.h"

namespace pedicel::cosserat::cases {
namespace {

RodModel in_air(double drag_area, const Vec3& velocity, double gust = 0.0, double frequency = 0.0) {
  RodModel model = Joint::model();
  model.air.push_back({drag_area, velocity, gust * velocity});
  model.gust_frequency = frequency;
  return model;
}

double expected_angle(const RodModel& model, double start, double time) {
  const SegmentAir& air = model.air[0];
  const double arm = Joint::length / 2;
  const double c = 0.5 * SegmentAir::density * air.drag_area * Joint::length;
  const auto moment = [&](double t, double phi, double rate) {
    const double wind =
        -air.velocity.z() - air.gust.z() * std::sin(2.0 * pi * model.gust_frequency * t);
    const double u = wind * std::cos(phi) - arm * rate;
    return -Joint::stiffness(model) * phi + arm * c * std::abs(u) * u;
  };
  return runge_kutta(Joint::inertia(model), start, 0.0, time, 20000, moment);
}

double found_angle(const RodModel& model, double start, double time, int steps) {
  Simulation sim(model, settings_with(Integrator::bdf2));
  Joint::bend(sim.model, sim.state, start);
  for (int i = 0; i < steps; ++i) sim.step(time / steps, no_gravity);
  return Joint::angle(sim.state);
}

TEST(Drag, SwingAgainstTheEquation) {
  const RodModel model = in_air(0.3, Vec3::Zero());
  const double time = 3.0 / Joint::frequency(model), start = 0.3;
  const double expected = expected_angle(model, start, time);
  EXPECT_LT(expected, 0.8 * start);
  EXPECT_NEAR(found_angle(model, start, time, 3000), expected, 1.0e-4 * start);
}

// A plate on the segment, its normal turned by `tilt` from -z towards the segment, in air that
// moves along x and z: each part of the velocity has its own drag.
TEST(PlateDrag, SwingAgainstTheEquation) {
  constexpr double normal = 0.4, tangential = 0.1;
  for (const double tilt : {0.0, 0.5, 1.3})
    for (const Vec3& wind : {Vec3(0, 0, 0), Vec3(3, 0, -5)}) {
      RodModel model = in_air(0.0, wind);
      SegmentAir& air = model.air[0];
      air.plate_normal = normal;
      air.plate_tangential = tangential;
      const Vec3 drawn(std::sin(tilt), 0.0, -std::cos(tilt));
      air.plate = model.elements[0].drawn_rotation.conjugate() * drawn;
      const double arm = Joint::length / 2, c = 0.5 * SegmentAir::density * Joint::length;
      const auto moment = [&](double, double phi, double rate) {
        const Quat turned = Joint::turned(phi);
        const Vec3 towards = turned * -Vec3::UnitZ(), n = turned * drawn;
        const Vec3 relative = wind - arm * rate * towards;
        const Vec3 along = relative.dot(n) * n, across = relative - along;
        const Vec3 force =
            c * (normal * along.norm() * along + tangential * across.norm() * across);
        return -Joint::stiffness(model) * phi + arm * force.dot(towards);
      };
      const double time = 3.0 / Joint::frequency(model), start = 0.3;
      const double expected = runge_kutta(Joint::inertia(model), start, 0.0, time, 20000, moment);
      EXPECT_NEAR(found_angle(model, start, time, 3000), expected, 2.0e-4 * start)
          << tilt << ", wind " << wind.transpose();
      EXPECT_GT(std::abs(expected - start), 0.05 * start);
    }
}

// Beside other drag it adds up: in still air a plate across the way is a segment with that area.
TEST(PlateDrag, AddsToOtherDrag) {
  RodModel both = in_air(0.1, Vec3::Zero());
  both.air[0].plate_normal = 0.2;
  both.air[0].plate = both.elements[0].drawn_rotation.conjugate() * Vec3::UnitZ();
  const double time = 2.0 / Joint::frequency(both);
  EXPECT_NEAR(found_angle(both, 0.3, time, 1000),
              found_angle(in_air(0.3, Vec3::Zero()), 0.3, time, 1000), 1.0e-9);
}

// Energy a cycle, integral of c (l/2)^3 |phi'|^3 dt = 8/3 q w^2 A^3, gives A' = -4/(3 pi) q w A^2,
// with q = c (l/2)^3 / I: 1/A grows evenly.
TEST(Drag, AmplitudeFallsWithOneOverTime) {
  const RodModel model = in_air(0.1, Vec3::Zero());
  const double f = Joint::frequency(model), start = 0.3, arm = Joint::length / 2;
  const double c = 0.5 * SegmentAir::density * 0.1 * Joint::length;
  const double q = c * arm * arm * arm / Joint::inertia(model);
  constexpr int periods = 8;
  const double expected = 1.0 / (1.0 / start + 4.0 / (3.0 * pi) * q * 2.0 * pi * f * periods / f);
  EXPECT_LT(expected, 0.8 * start);
  EXPECT_NEAR(found_angle(model, start, periods / f, 4000) / expected, 1.0, 0.02);
}

TEST(Drag, SecondOrderInTime) {
  const RodModel model = in_air(0.3, Vec3(0, 0, -4));
  const double time = 1.2 / Joint::frequency(model);
  const double expected = found_angle(model, 0.3, time, 6400);
  double error[2];
  for (int i = 0; i < 2; ++i)
    error[i] = std::abs(found_angle(model, 0.3, time, 100 << i) - expected);
  EXPECT_GT(order(error[0], error[1]), 1.8);
}

// A weak steady wind across a cantilever is an even load w = 1/2 rho drag_area U^2, whose tip
// deflection is w L^4/(8 EI) (Euler-Bernoulli). Loads in the middles of 20 segments: within
// 1/(2 n)^2; the deflection of L/40 and the shear of slender rods add 1e-3.
TEST(Wind, SettledDeflection) {
  RodModel model = PeerCantilever::model(20);
  const double area = 0.006, speed = 0.25;
  model.air.assign(20, {area, Vec3(0, speed, 0), Vec3::Zero()});
  RodState state = drawn_state(model);
  EXPECT_EQ(settle(model, state, no_gravity).errors, 0u);
  const double load = 0.5 * SegmentAir::density * area * speed * speed;
  const double expected =
      load * std::pow(PeerCantilever::length, 4) / (8.0 * PeerCantilever::bending);
  EXPECT_NEAR(state.position.back().y() / expected, 1.0, 5.0e-3);
  // It stays there while the wind lasts.
  Simulation sim(model, settings_with(Integrator::bdf2));
  sim.state = state;
  for (int i = 0; i < 50; ++i) sim.step(1.0 / 240.0, no_gravity);
  EXPECT_LT((sim.tip() - state.position.back()).norm(), 1.0e-8);
}

// In a strong wind the segment yields until K phi = l/2 c U^2 cos^2(phi) (the drag turns with it).
TEST(Wind, SettledAngleInAStrongWind) {
  const RodModel model = in_air(1.0, Vec3(0, 0, -14));
  RodState state = drawn_state(model);
  EXPECT_EQ(settle(model, state, no_gravity).errors, 0u);
  const double phi = Joint::angle(state);
  const double c = 0.5 * SegmentAir::density * 1.0 * Joint::length;
  EXPECT_GT(phi, 0.2);
  EXPECT_NEAR(
      Joint::length / 2 * c * std::pow(14.0 * std::cos(phi), 2) / (Joint::stiffness(model) * phi),
      1.0, 1.0e-6);
}

TEST(Wind, GustAgainstTheEquation) {
  const double f = Joint::frequency(Joint::model());
  const RodModel model = in_air(0.3, Vec3(0, 0, -6), 0.4, 0.3 * f);
  const double time = 4.0 / f;
  const double expected = expected_angle(model, 0.0, time);
  EXPECT_NEAR(found_angle(model, 0.0, time, 4000), expected, 1.0e-3 * std::abs(expected));
  // The gust matters, and starts from the mean wind.
  EXPECT_GT(std::abs(expected - expected_angle(in_air(0.3, Vec3(0, 0, -6)), 0.0, time)),
            0.02 * std::abs(expected));
}

}  // namespace
}  // namespace pedicel::cosserat::cases
