// Strings that tie a rod to a fixed point: what they bear, and the frequency of a tied rod.
//
// A tip spring K (N/m) at a clamped Euler-Bernoulli beam: with b = beta L and kappa = K L^3 / (E I)
//   b^3 (1 + cos b cosh b) = kappa (sinh b cos b - cosh b sin b)
// (Blevins, Formulas for Natural Frequency and Mode Shape, section 8.3).
#include <gtest/gtest.h>

#include "plugins/cosserat/solver/rod_system.h"
#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

using Peer = PeerCantilever;
constexpr int segments = 20;
constexpr double spring = 3.0 * Peer::bending / (Peer::length * Peer::length * Peer::length);

Tie upward(double height, double length, double stiffness) {
  Tie tie;
  tie.element = segments - 1;
  tie.anchor_W = Vec3(Peer::length, 0, height);
  tie.length = length;
  tie.stiffness = stiffness;
  return tie;
}

// The peers' cantilever on a string.
struct Tied : RodSystem {
  Tied(const Tie& tie, double damping) : RodSystem(settings_with(Integrator::bdf2)) {
    RodModel model = Peer::model(segments);
    for (Element& element : model.elements) element.mass_damping = damping;
    add_plant(std::move(model));
    ties(0).push_back(tie);
  }
};

double tip_height(const RodSystem& system) {
  return system.state(0).position.back().z();
}

// Pre-tensioned: 3 E I / L^3 u = k (height - length - u).
TEST(RodTie, ATautStringLiftsTheTipByItsShareOfTheStiffness) {
  const double stiffness = 2.0 * spring, slack = -0.003, height = 0.5;
  Tied system(upward(height, height + slack, stiffness), 10.0);
  for (int i = 0; i < 2000; ++i) system.step(1.0 / 240.0, no_gravity);
  const double lifted = -slack * stiffness / (stiffness + spring);
  EXPECT_NEAR(tip_height(system), lifted, 0.01 * lifted);
  EXPECT_NEAR(tension(system.state(0), system.ties(0)[0]), spring * lifted, 0.02 * spring * lifted);
}

TEST(RodTie, ASlackStringBearsNothing) {
  Tied system(upward(0.5, 0.51, 1.0e4), 0.0), free(upward(0.5, 0.51, 0.0), 0.0);
  for (Tied* one : {&system, &free})
    one->loads(0).push_back({segments - 1, 0.0, Vec3(0, 0, 0.002 * spring), Vec3::Zero()});
  for (int i = 0; i < 100; ++i) {
    system.step(1.0 / 240.0, no_gravity);
    free.step(1.0 / 240.0, no_gravity);
    ASSERT_EQ(tension(system.state(0), system.ties(0)[0]), 0.0);
  }
  EXPECT_GT(tip_height(system), 1e-4);
  EXPECT_EQ(tip_height(system), tip_height(free));
}

// A string at the tip of a beam under its own weight bears 3/8 of it (Gere & Timoshenko, Mechanics
// of Materials, section 10.3).
TEST(RodTie, AHungRodWeighsOnItsStringAsStaticsSays) {
  Tied system(upward(0.5, 0.5, 1.0e4), 10.0);
  for (int i = 0; i < 2000; ++i) system.step(1.0 / 240.0, gravity);
  const double weight = Peer::mass_per_length * Peer::length * 9.81;
  EXPECT_NEAR(tension(system.state(0), system.ties(0)[0]), 0.375 * weight, 0.03 * weight);
}

double tied_root(double kappa) {
  const auto f = [&](double b) {
    return b * b * b * (1.0 + std::cos(b) * std::cosh(b)) -
           kappa * (std::sinh(b) * std::cos(b) - std::cosh(b) * std::sin(b));
  };
  double low = 1.8, high = 3.9;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == (f(low) > 0.0) ? low : high) = middle;
  }
  return low;
}

TEST(RodTie, ATiedRodHasItsFirstFrequency) {
  for (const double kappa : {3.0, 30.0}) {
    const double stiffness = kappa * Peer::bending / (Peer::length * Peer::length * Peer::length);
    // So long, and so taut, that it pulls as a linear spring in both directions.
    const double height = 50.0, stretch = 0.002;
    Tied system(upward(height, height - stretch, stiffness), 20.0);
    const double dt = 1.0 / 960.0;
    for (int i = 0; i < 4000; ++i) system.step(dt, no_gravity);
    RodModel& model = system.edit_model(0);
    for (Element& element : model.elements) element.mass_damping = 0.0;
    const double rest = tip_height(system);
    for (Vec3& v : system.edit_state(0).velocity) v.z() += 1.0e-3;
    system.edit_state(0).previous_dt = 0.0;
    Oscillation signal;
    for (int i = 0; signal.crossings() < 9 && i < 20000; ++i) {
      signal.add(system.state(0).time, tip_height(system) - rest);
      system.step(dt, no_gravity);
    }
    const double b = tied_root(kappa);
    const double exact = b * b / (Peer::length * Peer::length) *
                         std::sqrt(Peer::bending / Peer::mass_per_length) / (2.0 * pi);
    EXPECT_NEAR(signal.frequency() / exact, 1.0, 0.02) << "kappa " << kappa;
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
