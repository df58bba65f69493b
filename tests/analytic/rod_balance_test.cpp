// Energy, momentum and angular momentum of undamped rods that swing or fly.
#include <gtest/gtest.h>

#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

double mass_of(const RodModel& model) {
  double mass = 0.0;
  for (const Element& element : model.elements) mass += element.mass;
  return mass;
}

Vec3 momentum_of(const Simulation& sim) {
  Vec3 sum = Vec3::Zero();
  for (int e = 0; e < sim.model.size(); ++e)
    sum += sim.model.elements[e].mass * sim.state.velocity[e];
  return sum;
}

// Linear momentum, exactly as the scheme has it: BDF2 says
//   (3 P(n+1) - 4 P(n) + P(n-1)) / (2 dt) = M g - R(n+1),
// with R the force of the root segment on the rest, the only force from outside besides weight:
// all other joint forces cancel in pairs. The tolerance is Newton's: 1e-6 of the weight.
TEST(RodBalance, MomentumChangesByWeightAndTheRootsForce) {
  Simulation sim(PeerCantilever::model(12), settings_with(Integrator::bdf2));
  const double dt = 1.0 / 240.0;
  const double mass = mass_of(sim.model);
  Vec3 before = momentum_of(sim);
  sim.step(dt, gravity);
  Vec3 now = momentum_of(sim);
  for (int i = 0; i < 240; ++i) {
    sim.step(dt, gravity);
    const Vec3 next = momentum_of(sim);
    const Vec3 rate = (3.0 * next - 4.0 * now + before) / (2.0 * dt);
    const Vec3 root = sim.state.orientation[0] * joint_load(sim.model, sim.state, 0).force;
    ASSERT_LT((rate - mass * gravity + root).norm(), 1e-6 * mass * 9.81) << "step " << i;
    before = now;
    now = next;
  }
}

Vec3 centre_of(const RodModel& model, const RodState& state, int e) {
  return state.position[e] - model.elements[e].com_back * (state.orientation[e] * Vec3::UnitZ());
}

// Sum of c x m v + R I omega, about the origin.
Vec3 angular_momentum(const RodModel& model, const RodState& state) {
  Vec3 sum = Vec3::Zero();
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    sum += centre_of(model, state, e).cross(element.mass * state.velocity[e]) +
           state.orientation[e] * element.inertia.cwiseProduct(state.angular_velocity[e]);
  }
  return sum;
}

// What a swing's angular momentum about the clamp lacks after 0.5 s, against the impulse of the
// torques from outside: the weight's and the clamp's moment (its force has no lever), summed by the
// trapezoidal rule. As a share of the weight's impulse.
double angular_defect(int steps) {
  Simulation sim(PeerCantilever::model(10), settings_with(Integrator::bdf2));
  const double dt = 0.5 / steps;
  const auto torque = [&](bool with_clamp) {
    Vec3 sum = Vec3::Zero();
    for (int e = 0; e < sim.model.size(); ++e)
      sum += centre_of(sim.model, sim.state, e).cross(sim.model.elements[e].mass * gravity);
    if (with_clamp) sum -= sim.state.orientation[0] * joint_load(sim.model, sim.state, 0).moment;
    return sum;
  };
  Vec3 impulse = Vec3::Zero(), before = torque(true);
  double weight = 0.0;
  for (int i = 0; i < steps; ++i) {
    sim.step(dt, gravity);
    const Vec3 now = torque(true);
    impulse += 0.5 * dt * (before + now);
    weight += dt * torque(false).norm();
    before = now;
  }
  return (angular_momentum(sim.model, sim.state) - impulse).norm() / weight;
}

// Angular momentum is no linear function of the unknowns, so the scheme keeps it to its own order:
// a quarter of the defect with half the step. The sudden start rings all modes; the trapezoidal
// rule and BDF2 are second order in those that the step resolves and bounded in the others.
TEST(RodBalance, AngularMomentumChangesByTheTorques) {
  const double coarse = angular_defect(480), fine = angular_defect(960);
  RecordProperty("defect_960", std::to_string(coarse));
  RecordProperty("defect_1920", std::to_string(fine));
  RecordProperty("order", std::to_string(order(coarse, fine)));
  EXPECT_LT(coarse, 1.0e-4);
  EXPECT_GE(order(coarse, fine), 1.9);
}

// A rod that nothing holds: its clamp has no stiffness. It is thrown, and tumbles and bends.
Simulation thrown_rod() {
  RodModel model = PeerCantilever::model(10);
  model.elements[0].stretch_stiffness.setZero();
  model.elements[0].bend_stiffness.setZero();
  Simulation sim(std::move(model), settings_with(Integrator::bdf2));
  const Vec3 spin(0.5, 3.0, 2.0), thrown(1.0, 0.5, 2.0);  // rad/s, m/s
  const Vec3 middle(0.5 * PeerCantilever::length, 0, 0);
  for (int e = 0; e < sim.model.size(); ++e) {
    sim.state.velocity[e] = thrown + spin.cross(centre_of(sim.model, sim.state, e) - middle);
    sim.state.angular_velocity[e] = sim.state.orientation[e].conjugate() * spin;
  }
  return sim;
}

// M g t, exactly, by either scheme: gravity is constant. The tolerance is Newton's.
TEST(RodBalance, FreeFlightKeepsItsMomentum) {
  Simulation sim = thrown_rod();
  const Vec3 start = momentum_of(sim);
  const double weight = mass_of(sim.model) * gravity.norm();
  for (int i = 0; i < 240; ++i) {
    sim.step(1.0 / 240.0, gravity);
    const Vec3 expected = start + mass_of(sim.model) * sim.state.time * gravity;
    ASSERT_LT((momentum_of(sim) - expected).norm(), 1e-8 * weight) << "step " << i;
  }
}

// About the centre of mass angular momentum stays. Share that is lost after 0.5 s.
double lost_spin(int steps) {
  Simulation sim = thrown_rod();
  const auto spin = [&] {
    const double mass = mass_of(sim.model);
    Vec3 centre = Vec3::Zero();
    for (int e = 0; e < sim.model.size(); ++e)
      centre += sim.model.elements[e].mass / mass * centre_of(sim.model, sim.state, e);
    return Vec3(angular_momentum(sim.model, sim.state) - centre.cross(momentum_of(sim)));
  };
  const Vec3 start = spin();
  for (int i = 0; i < steps; ++i) sim.step(0.5 / steps, gravity);
  return (spin() - start).norm() / start.norm();
}

// To the scheme's order: a quarter with half the step, and little of it.
TEST(RodBalance, FreeFlightKeepsItsAngularMomentum) {
  const double coarse = lost_spin(120), fine = lost_spin(240);
  RecordProperty("lost_240", std::to_string(coarse));
  RecordProperty("lost_480", std::to_string(fine));
  EXPECT_LT(coarse, 1.0e-3);
  EXPECT_GE(order(coarse, fine), 1.9);
}

struct Loss {
  double largest_gain, lost;  // share of the energy that moves (the fall to the settled shape)
};

Loss swing(double dt) {
  RodState settled = drawn_state(PeerCantilever::model(10));
  settle(PeerCantilever::model(10), settled, gravity);
  Simulation sim(PeerCantilever::model(10), settings_with(Integrator::bdf2));
  const double start = energy_of(sim.model, sim.state, gravity).total();
  const double scale = start - energy_of(sim.model, settled, gravity).total();
  double lowest = start, gain = 0.0;
  while (sim.state.time < 2.0) {
    sim.step(dt, gravity);
    const double total = energy_of(sim.model, sim.state, gravity).total();
    gain = std::max(gain, total - lowest);
    lowest = std::min(lowest, total);
  }
  return {gain / scale, (start - energy_of(sim.model, sim.state, gravity).total()) / scale};
}

// BDF2 damps a mode by y^3/4 (y = omega dt): the first hardly, those it cannot resolve strongly. So
// the sudden start's higher modes are lost and the swing stays: less than 2 % in 2 s at 1/240 s,
// and a fraction of that with a smaller step. Energy never grows beyond the ripple that comes with
// the scheme's O(y^2) error of a mode's energy in the course of a period.
TEST(RodBalance, EnergyOfAnUndampedSwing) {
  const Loss coarse = swing(1.0 / 240.0), fine = swing(1.0 / 960.0);
  RecordProperty("lost_240", std::to_string(coarse.lost));
  RecordProperty("lost_960", std::to_string(fine.lost));
  EXPECT_LT(coarse.lost, 0.02);
  EXPECT_GT(fine.lost, 0.0);
  EXPECT_LT(fine.lost, 0.3 * coarse.lost);
  EXPECT_LT(fine.largest_gain, 0.002);
}

// The reference cantilever, released in its first mode at 60 steps a period: the energy falls by
// exp(2 Re growth) a step and by nothing else, 3.5 % in ten periods. Energies are means over 60
// steps, about a period, which evens out the ripple of O(y^2) within it; the first two periods let
// go what the mode's shape (of a beam without shear) holds of others. Tolerance 2 % of the loss:
// the mode at its amplitude of 1e-4 m is linear to (1e-4 / 0.4)^2.
TEST(RodBalance, EnergyDriftIsTheSchemesOwnDamping) {
  const CantileverMode mode(1, PeerCantilever::length);
  const double exact =
      mode.angular_frequency(PeerCantilever::bending, PeerCantilever::mass_per_length);
  const double dt = 2.0 * pi / (60.0 * exact);
  Simulation sim(PeerCantilever::model(20), settings_with(Integrator::bdf2));
  set_mode_shape(sim.model, sim.state, mode, 1.0e-4, Vec3::UnitZ());
  const auto mean_over_a_period = [&] {
    double sum = 0.0;
    for (int i = 0; i < 60; ++i) {
      sim.step(dt, no_gravity);
      sum += energy_of(sim.model, sim.state, no_gravity).total() / 60.0;
    }
    return sum;
  };
  mean_over_a_period();
  mean_over_a_period();
  const double first = mean_over_a_period();
  double last = first;
  for (int period = 0; period < 10; ++period) last = mean_over_a_period();
  const double expected = 600.0 * 2.0 * bdf2_growth(exact * dt).real();
  RecordProperty("lost_in_ten_periods", std::to_string(1.0 - last / first));
  EXPECT_NEAR(std::log(last / first) / expected, 1.0, 0.02);
}

// Galilei: a rod that its clamp carries along evenly is at rest in its own frame, and damping must
// not tell. Straight and unloaded as drawn, so the strain is zero in exact arithmetic.
TEST(RodBalance, AClampThatMovesEvenlyIsNotFelt) {
  const Vec3 carried(0.3, 0.2, 1.0);  // m/s
  const double dt = 1.0 / 240.0;
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::bdf2}) {
    RodModel model = PeerCantilever::model(10);
    for (Element& element : model.elements) element.damping_time = 0.05;
    Simulation sim(std::move(model), settings_with(integrator));
    for (Vec3& velocity : sim.state.velocity) velocity = carried;
    for (int i = 1; i <= 120; ++i) {
      sim.state.root.position = i * dt * carried;
      sim.step(dt, no_gravity);
      ASSERT_LT(strain_of(sim.model, sim.state, 0).stretch.norm(), 1e-9) << "step " << i;
    }
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
