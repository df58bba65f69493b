// Internal friction, yield, and the hardening joint.
//
// A Jenkins element of stiffness k = r K that slips at a moment L, beside a spring (1 - r) K,
// driven over a full cycle of amplitude A: the slider goes from stuck to slipping after 2 L/k from
// each reversal, and the loop's area is 4 L (A - L/k).
#include <gtest/gtest.h>

#include "tests/analytic/effects/joint_cases.h"

namespace pedicel::cosserat::cases {
namespace {

// Drives the joint's angle along `path` (rad), slowly, and integrates moment d phi over each piece.
std::vector<double> work_along(Simulation& sim, const std::vector<double>& path, int steps) {
  std::vector<double> work;
  double phi = Joint::angle(sim.state), moment = Joint::moment(sim.model, sim.state);
  for (const double target : path) {
    double sum = 0.0;
    const double from = Joint::angle(sim.state);
    for (int i = 1; i <= steps; ++i) {
      hold_at(sim.model, from + (target - from) * i / steps);
      for (int k = 0; k < 3; ++k) sim.step(1.0, no_gravity);
      const double phi_now = Joint::angle(sim.state);
      const double moment_now = Joint::moment(sim.model, sim.state);
      sum += 0.5 * (moment + moment_now) * (phi_now - phi);
      phi = phi_now;
      moment = moment_now;
    }
    work.push_back(sum);
  }
  return work;
}

// Backward Euler with steps of 1 s: no inertia is left. Corners are cut at most by one step in 200.
TEST(InternalFriction, LoopAreaIsJenkins) {
  constexpr double ratio = 0.3, amplitude = 0.5;
  for (const double slip : {0.1, 0.3}) {  // rad, L/k
    RodModel model = Joint::model();
    const double limit = ratio * Joint::stiffness(model) * slip;
    set_laws(model, [&](int) {
      JointLaw law;
      add_friction(law, ratio, limit);
      return law;
    });
    hold_direction(model);
    Simulation sim(model, settings_with(Integrator::backward_euler));
    settle(sim.model, sim.state, no_gravity);
    const auto work = work_along(sim, {amplitude, -amplitude, amplitude}, 200);
    const double expected = 4.0 * limit * (amplitude - slip);
    EXPECT_NEAR((work[1] + work[2]) / expected, 1.0, 1.0e-3);
    const double elastic = (1.0 - ratio) * Joint::stiffness(model) * amplitude;
    EXPECT_NEAR(Joint::moment(sim.model, sim.state) / (elastic + limit), 1.0, 1.0e-5);
  }
}

// At the settled shape the slider is at zero: that shape is the one of (1 - r) K.
TEST(InternalFriction, SettlesWithoutTheSlider) {
  constexpr double ratio = 0.25;
  RodModel model = PeerCantilever::model(10), soft = model;
  set_laws(model, [&](int) {
    JointLaw law;
    add_friction(law, ratio, 1.0e-4);
    return law;
  });
  for (Element& element : soft.elements) {
    element.bend_stiffness.x() *= 1.0 - ratio;
    element.bend_stiffness.y() *= 1.0 - ratio;
  }
  Simulation sim(model, settings_with(Integrator::bdf2));
  RodState expected = drawn_state(soft);
  EXPECT_EQ(settle(sim.model, sim.state, gravity).errors, 0u);
  settle(soft, expected, gravity);
  EXPECT_LT((sim.tip() - expected.position.back()).norm(), 1.0e-8);
  const Vec3 tip = sim.tip();
  for (int i = 0; i < 100; ++i) sim.step(1.0 / 240.0, gravity);
  EXPECT_LT((sim.tip() - tip).norm(), 1.0e-7);
}

JointLaw yielding(double limit) {
  JointLaw law;
  add_yield(law, limit);
  return law;
}

// Elastic-perfectly plastic: bent to A beyond the yield angle Y = L/K and let go, it keeps A - Y;
// bent to less than Y, nothing.
TEST(Yield, KeepsWhatGoesBeyondTheYieldAngle) {
  constexpr double yield_angle = 0.2;
  for (const double amplitude : {0.15, 0.5}) {
    RodModel model = Joint::model();
    const double limit = Joint::stiffness(model) * yield_angle;
    set_laws(model, [&](int) { return yielding(limit); });
    hold_direction(model);
    Simulation sim(model, settings_with(Integrator::backward_euler));
    settle(sim.model, sim.state, no_gravity);
    work_along(sim, {amplitude}, 50);
    EXPECT_NEAR(Joint::moment(sim.model, sim.state) /
                    (Joint::stiffness(model) * std::min(amplitude, yield_angle)),
                1.0, 1.0e-5);
    sim.model.supports[0].rotation_stiffness.setZero();
    for (int i = 0; i < 20; ++i) sim.step(1.0, no_gravity);
    EXPECT_NEAR(Joint::angle(sim.state), std::max(0.0, amplitude - yield_angle), 1.0e-6);
    EXPECT_NEAR(sim.state.joint_memory[0].norm(), std::max(0.0, amplitude - yield_angle), 1.0e-6);
  }
}

// The settled shape of a virgin rod under a load that its first joint cannot bear elastically at
// the drawn angle: it bends until the lever is short enough, and no joint carries more than L.
TEST(Yield, TheSettledShapeRespectsIt) {
  RodModel model = PeerCantilever::model(10);
  RodState elastic = drawn_state(model);
  settle(model, elastic, gravity);
  const double limit = 0.8 * joint_load(model, elastic, 0).moment.norm();
  set_laws(model, [&](int) { return yielding(limit); });
  RodState state = drawn_state(model);
  EXPECT_EQ(settle(model, state, gravity).errors, 0u);
  EXPECT_LT(state.position.back().z(), elastic.position.back().z() - 0.01);
  double largest = 0.0;
  for (int e = 0; e < model.size(); ++e)
    largest = std::max(
        largest, joint_response(model, state, e, strain_of(model, state, e).bend).moment.norm());
  EXPECT_NEAR(largest / limit, 1.0, 1.0e-6);
}

// Pure moment: every joint turns by phi with M = K phi (1 + b (phi/phi0)^2), phi0 = k0 l_bar, that
// is M = EI k (1 + b (k/k0)^2).
TEST(Nonlinearity, PureMoment) {
  constexpr double length = 0.4, k0 = 3.0;
  for (const double b : {0.5, -0.1}) {
    RodModel model = straight_rod(length, 8, Joint::section(), Vec3::UnitX());
    set_laws(model, [&](int e) {
      JointLaw law;
      const double phi0 = k0 * length / 8 * (e == 0 ? 0.5 : 1.0);
      law.term("material_nonlinearity") = b / (phi0 * phi0);
      return law;
    });
    for (const double k : {0.5, 2.5, 4.0}) {
      const double moment = Joint::section().bend1 * k * (1.0 + b * k * k / (k0 * k0));
      const Load load{7, 0.0, Vec3::Zero(), Vec3(0, moment, 0)};
      RodState state = drawn_state(model);
      EXPECT_EQ(settle(model, state, no_gravity, {&load, 1}).errors, 0u);
      const Vec3 along = state.orientation[7] * Vec3::UnitZ();
      // The last half segment is straight.
      EXPECT_NEAR(std::atan2(-along.z(), along.x()) / (k * length * 7.5 / 8), 1.0, 1.0e-8)
          << "b " << b << ", k " << k;
    }
  }
}

// Past its peak a softening joint goes on at the peak's moment: M_peak = 2/3 K phi_peak,
// phi_peak = phi0 / sqrt(-3 b).
TEST(Nonlinearity, SoftensToAPlateau) {
  RodModel model = Joint::model();
  set_laws(model, [](int) {
    JointLaw law;
    law.term("material_nonlinearity") = -1.0 / (3.0 * 0.2 * 0.2);  // peak at 0.2 rad
    return law;
  });
  hold_direction(model);
  Simulation sim(model, settings_with(Integrator::backward_euler));
  for (const double phi : {0.2, 0.35, 0.6}) {
    work_along(sim, {phi}, 5);
    EXPECT_NEAR(Joint::moment(sim.model, sim.state) / (2.0 / 3.0 * Joint::stiffness(model) * 0.2),
                1.0, 1.0e-6);
  }
}

// Backbone of one joint, I phi'' = -K phi (1 + b (phi/phi0)^2): where it is after some periods.
TEST(Nonlinearity, SwingsAsTheEquationSays) {
  constexpr double phi0 = 0.5, start = 0.4;
  for (const double b : {0.8, -0.3}) {
    RodModel model = Joint::model();
    set_laws(model, [&](int) {
      JointLaw law;
      law.term("material_nonlinearity") = b / (phi0 * phi0);
      return law;
    });
    Simulation sim(model, settings_with(Integrator::bdf2));
    Joint::bend(sim.model, sim.state, start);
    const double time = 1.7 / Joint::frequency(model), k = Joint::stiffness(model);
    const auto moment = [&](double, double phi, double) {
      return -k * phi * (1.0 + b * phi * phi / (phi0 * phi0));
    };
    const double expected = runge_kutta(Joint::inertia(model), start, 0.0, time, 4000, moment);
    constexpr int steps = 1600;
    for (int i = 0; i < steps; ++i) sim.step(time / steps, no_gravity);
    EXPECT_NEAR(Joint::angle(sim.state), expected, 2.0e-3);
    // The linear joint is elsewhere by far more.
    EXPECT_GT(std::abs(expected - start * std::cos(2.0 * pi * 1.7)), 0.05);
  }
}

// The modulus at a clock time: E (1 + rate (clock + t)), frequency with its square root.
TEST(Drift, FrequencyFollowsTheClock) {
  constexpr double rate = -1.0e-4;
  RodModel model = Joint::model();
  const double f = Joint::frequency(model);
  model.stiffness_drift = rate;
  for (const double clock : {0.0, 3600.0}) {
    model.clock = clock;
    Simulation sim(model, settings_with(Integrator::bdf2));
    Joint::bend(sim.model, sim.state, 1.0e-3);
    const double time = 2.3 / f;
    const auto moment = [&](double t, double phi, double) {
      return -Joint::stiffness(model) * (1.0 + rate * (clock + t)) * phi;
    };
    const double expected = runge_kutta(Joint::inertia(model), 1.0e-3, 0.0, time, 4000, moment);
    for (int i = 0; i < 2400; ++i) sim.step(time / 2400, no_gravity);
    EXPECT_NEAR(Joint::angle(sim.state), expected, 1.0e-5);
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
