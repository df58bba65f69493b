// Bending frequencies, and what the time integration does to them.
//
// A clamped-free Euler-Bernoulli beam: omega = (beta L)^2 sqrt(EI / (rho A L^4)) with
// cosh(bL) cos(bL) = -1: bL = 1.8751, 4.6941. For the peers' cantilever f1 = 1.10599 Hz. Rotary
// inertia and shear, which the rods have and this beam has not, lower f2 by about
// (beta r)^2 / 2 ~ 1e-4.
//
// In time, on y = omega dt: with xi = e^w, BDF2 says 3/2 - 2/xi + 1/(2 xi^2) = z, that is
// w - w^3/3 + w^4/4 + ... = z, so for z = i y
//   w = i y (1 - y^2/3) - y^4/4:  frequency low by y^2/3, damping ratio y^3/4,
// and backward Euler, 1 - 1/xi = z, gives w = i y (1 - y^2/3) - y^2/2: damping ratio y/2.
#include <gtest/gtest.h>

#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double length = PeerCantilever::length;

// Lets the peers' cantilever swing in one of its modes.
Oscillation swing(int number, int elements, double dt, int crossings, Integrator integrator) {
  Simulation sim(PeerCantilever::model(elements), settings_with(integrator));
  const CantileverMode mode(number, length);
  set_mode_shape(sim.model, sim.state, mode, 1.0e-4, Vec3::UnitZ());
  Oscillation signal;
  for (int i = 0; signal.crossings() < crossings && i < 100000; ++i) {
    signal.add(sim.state.time, modal_amplitude(sim.model, sim.state, mode, Vec3::UnitZ()));
    sim.step(dt, no_gravity);
  }
  return signal;
}

double exact_frequency(int number) {
  return CantileverMode(number, length)
             .angular_frequency(PeerCantilever::bending, PeerCantilever::mass_per_length) /
         (2.0 * pi);
}

TEST(RodFrequency, ReferenceIsThePublishedOne) {
  EXPECT_NEAR(exact_frequency(1), 1.10599, 1e-5);
}

TEST(RodFrequency, FirstAndSecondWithinOnePercent) {
  for (const int number : {1, 2}) {
    const Oscillation signal = swing(number, 20, 1.0 / 960.0, 9, Integrator::bdf2);
    const double error = signal.frequency() / exact_frequency(number) - 1.0;
    RecordProperty("frequency_error_" + std::to_string(number), std::to_string(error));
    RecordProperty("damping_ratio_" + std::to_string(number),
                   std::to_string(signal.damping_ratio()));
    EXPECT_LT(std::abs(error), 0.01) << "mode " << number;
    EXPECT_LT(signal.damping_ratio(), 1e-3) << "mode " << number;
  }
}

// The segment's own mass distribution: -0.11 / -0.40 % with 20 elements and small steps, where
// masses lumped to nodes give -4.9 % (child node) or -1.06 % (half to each). The order is taken
// from the differences between meshes: the time step's shift, y^2/3 = 7e-5, is the same in all.
TEST(RodFrequency, SecondOrderInElementLength) {
  double ratio[3];
  for (int i = 0; i < 3; ++i)
    ratio[i] =
        swing(1, 10 << i, 1.0 / 480.0, 21, Integrator::bdf2).frequency() / exact_frequency(1);
  const double found = order(ratio[1] - ratio[0], ratio[2] - ratio[1]);
  RecordProperty("order", std::to_string(found));
  EXPECT_GE(found, 1.9);
  EXPECT_NEAR(ratio[2], 1.0, 0.001);
}

// The scheme's own frequency shift and damping, at a step large enough that they stand out from the
// mesh (taken from a small step). y = 0.23 at 1/30 s: y^2/3 = 1.8 %, y^3/4 = 0.31 %; the next terms
// are a factor y^2 ~ 0.05 to y ~ 0.2 smaller.
TEST(RodFrequency, TimeIntegrationIsBdf2) {
  const double small = swing(1, 10, 1.0 / 1920.0, 5, Integrator::bdf2).frequency();
  const double dt = 1.0 / 30.0, y = 2.0 * pi * small * dt;
  const Oscillation signal = swing(1, 10, dt, 9, Integrator::bdf2);
  EXPECT_NEAR((signal.frequency() / small - 1.0) / (-y * y / 3.0), 1.0, 0.15);
  EXPECT_NEAR(signal.damping_ratio() / (y * y * y / 4.0), 1.0, 0.30);
}

// At 60 steps a period y = 2 pi / 60 and y^3/4 = 0.029 % of critical, less than the 0.1 % that a
// swing of many periods can bear. The period is the mesh's own, from steps eight times as small,
// whose shift by y^2/3 = 6e-5 does not matter: the damping goes with its cube. Tolerance: 20 half
// periods lose 1.8 % in all, and extremes found by parabolas through samples 6 degrees apart are
// off by up to (2 pi / 60)^4 / 128 = 1e-6, so 1 % is ample.
TEST(RodFrequency, DampsLessThanAThousandthAt60StepsAPeriod) {
  const double rough = exact_frequency(1);
  const double frequency = swing(1, 20, 1.0 / (480.0 * rough), 9, Integrator::bdf2).frequency();
  const double dt = 1.0 / (60.0 * frequency);
  const Oscillation signal = swing(1, 20, dt, 22, Integrator::bdf2);
  const std::complex<double> growth = bdf2_growth(2.0 * pi / 60.0);
  const double expected = -growth.real() / std::abs(growth);
  RecordProperty("damping_ratio", std::to_string(signal.damping_ratio()));
  EXPECT_LT(signal.damping_ratio(), 1.0e-3);
  EXPECT_NEAR(signal.damping_ratio() / expected, 1.0, 0.01);
  EXPECT_NEAR(expected / (std::pow(2.0 * pi / 60.0, 3) / 4.0), 1.0, 0.05);  // the derivation above
  EXPECT_NEAR(signal.frequency() / frequency, growth.imag() / (2.0 * pi / 60.0), 2.0e-4);
}

TEST(RodFrequency, BackwardEulerDamps) {
  const double dt = 1.0 / 240.0, y = 2.0 * pi * exact_frequency(1) * dt;
  const Oscillation signal = swing(1, 10, dt, 9, Integrator::backward_euler);
  EXPECT_NEAR(signal.damping_ratio() / (y / 2.0), 1.0, 0.1);
}

// Order of convergence in dt of a large swing: the errors of the tip's place at 0.4 s with three
// steps, against BDF2 with a step 16 times as small as the smallest, whose own error is 1/256 of
// BDF2's least and nothing beside backward Euler's. The rod falls from the horizontal with damping,
// so that the sudden start does not keep modes ringing that no step here resolves.
Vec3 tip_after(Integrator integrator, int steps) {
  RodModel model = PeerCantilever::model(10);
  for (Element& element : model.elements) element.damping_time = 0.02;
  Simulation sim(model, settings_with(integrator));
  for (int k = 0; k < steps; ++k) sim.step(0.4 / steps, gravity);
  return sim.tip();
}

// The lower of the orders between the three.
double order_in_time(Integrator integrator, const Vec3& reference) {
  double error[3];
  for (int i = 0; i < 3; ++i) error[i] = (tip_after(integrator, 200 << i) - reference).norm();
  return std::min(order(error[0], error[1]), order(error[1], error[2]));
}

TEST(RodFrequency, SecondOrderInTimeWithBdf2) {
  const double found = order_in_time(Integrator::bdf2, tip_after(Integrator::bdf2, 12800));
  RecordProperty("order", std::to_string(found));
  EXPECT_GE(found, 1.9);
}

TEST(RodFrequency, FirstOrderInTimeWithBackwardEuler) {
  const double found =
      order_in_time(Integrator::backward_euler, tip_after(Integrator::bdf2, 12800));
  RecordProperty("order", std::to_string(found));
  EXPECT_NEAR(found, 1.0, 0.1);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
