// Relaxation and structural damping: joints with Maxwell branches.
//
// A standard linear solid held at phi since t = 0 carries K phi (1 - f + f exp(-t/tau)): its branch
// f K (phi - z), z' = (phi - z)/tau, z(0) = 0, loses phi - z = phi exp(-t/tau).
#include <gtest/gtest.h>

#include "tests/analytic/effects/joint_cases.h"

namespace pedicel::cosserat::cases {
namespace {

JointLaw relaxing(double fraction, double time, RelaxationStart start = RelaxationStart::settled) {
  JointLaw law;
  add_relaxation(law, fraction, time, start);
  return law;
}

// The joint is turned within one step, evenly, so the branch has felt it for half a step by its
// end: a shift of the curve by dt/2, f dt/(2 tau) = 2e-4 of the moment, taken into the reference
// exactly: (1 - e^-x)/x at the end of the first step.
TEST(Relaxation, MomentOfAHeldJoint) {
  constexpr double fraction = 0.3, tau = 0.5, dt = 1.0e-3, phi = 0.4;
  RodModel model = Joint::model(0.01);
  set_laws(model, [&](int) { return relaxing(fraction, tau); });
  hold_direction(model);
  Simulation sim(model, settings_with(Integrator::bdf2));
  settle(sim.model, sim.state, no_gravity);
  hold_at(sim.model, phi);
  const double elastic = Joint::stiffness(model) * phi, x = dt / tau;
  const double first = (1.0 - std::exp(-x)) / x;
  for (int i = 0; i < 1500; ++i) {
    sim.step(dt, no_gravity);
    if (i < 60) continue;  // the hold's own ringing
    const double expected = elastic * (1.0 - fraction + fraction * first * std::exp(-i * dt / tau));
    ASSERT_NEAR(Joint::moment(sim.model, sim.state) / expected, 1.0, 1.0e-4) << i;
  }
}

// With a tip held in place the whole rod relaxes alike: the reaction follows the same curve. The
// hold also keeps the tip from coming nearer, by 0.6 d^2/L: with d = 0.5 mm the tension of that is
// 1e-3 of the reaction, and does not relax.
TEST(Relaxation, ForceOfAHeldCantilever) {
  constexpr double fraction = 0.2, tau = 0.3, dt = 2.0e-3;
  RodModel model = straight_rod(0.3, 12, circle_section(0.003, {2.0e7, 0.3, 450.0, 0.0}),
                                Vec3::UnitX(), Vec3::Zero(), 0.01);
  set_laws(model, [&](int) { return relaxing(fraction, tau); });
  for (Element& element : model.elements) element.mass_damping = 20.0;
  Support support;
  support.element = 11;
  support.position = model.elements.back().drawn_position;
  support.position_stiffness = 100.0;
  model.supports.push_back(support);
  Simulation sim(model, settings_with(Integrator::bdf2));
  settle(sim.model, sim.state, no_gravity);
  sim.model.supports[0].position += Vec3(0, 0, 0.0005);
  const auto force = [&] { return 100.0 * (sim.model.supports[0].position - sim.tip()).z(); };
  RodModel elastic = sim.model;
  elastic.laws.clear();
  RodState held = sim.state;
  settle(elastic, held, no_gravity);
  const double whole = 100.0 * (sim.model.supports[0].position - held.position.back()).z();
  for (int i = 1; i <= 600; ++i) {
    sim.step(dt, no_gravity);
    if (i < 250) continue;  // ringing
    const double expected = whole * (1.0 - fraction + fraction * std::exp(-(i - 0.5) * dt / tau));
    ASSERT_NEAR(force() / expected, 1.0, 2.0e-3) << i;
  }
}

// From the settled shape on nothing relaxes, whatever hangs on the rod.
TEST(Relaxation, TheSettledShapeStays) {
  RodModel model = PeerCantilever::model(10);
  set_laws(model, [&](int) { return relaxing(0.4, 0.2); });
  Simulation sim(model, settings_with(Integrator::bdf2));
  EXPECT_EQ(settle(sim.model, sim.state, gravity).errors, 0u);
  const Vec3 tip = sim.tip();
  EXPECT_LT(tip.z(), -0.1);
  for (int i = 0; i < 240; ++i) sim.step(1.0 / 240.0, gravity);
  EXPECT_LT((sim.tip() - tip).norm(), 1.0e-7);
}

// From the unloaded shape on the sag grows from the elastic one to that of E (1 - f).
TEST(Relaxation, FromTheUnloadedShapeTheSagGrows) {
  RodModel model = PeerCantilever::model(10);
  for (Element& element : model.elements) element.mass_damping = 14.0;
  set_laws(model, [&](int) { return relaxing(0.4, 0.1, RelaxationStart::unloaded); });
  Simulation sim(model, settings_with(Integrator::bdf2));
  settle(sim.model, sim.state, gravity);
  RodModel soft = PeerCantilever::model(10);
  RodState elastic = drawn_state(soft), relaxed = drawn_state(soft);
  settle(soft, elastic, gravity);
  EXPECT_LT((sim.tip() - elastic.position.back()).norm(), 1.0e-7);
  for (Element& element : soft.elements) element.bend_stiffness *= 0.6;
  settle(soft, relaxed, gravity);
  for (int i = 0; i < 480; ++i) sim.step(1.0 / 120.0, gravity);
  EXPECT_LT((sim.tip() - relaxed.position.back()).norm(), 1.0e-4);
  EXPECT_GT((relaxed.position.back() - elastic.position.back()).norm(), 0.02);
}

// A segment that hung under its weight for long, and is loaded by a moment at time 0: it hung where
// (1 - f) K phi = m g l/2 cos(phi), answers with K, and sinks on until (1 - f) K bears all.
TEST(Relaxation, HungItHasRelaxedUnderItsWeight) {
  constexpr double fraction = 0.6, tau = 0.2, g = 40.0;  // m/s2, so that it sinks far
  const Vec3 down(0, 0, -g);
  RodModel model = Joint::model(0.05);
  model.elements[0].mass_damping = 5.0;
  set_laws(model, [&](int) { return relaxing(fraction, tau, RelaxationStart::hung); });
  const double k = Joint::stiffness(model), load = 0.3 * k;
  const double weight = model.elements[0].mass * g * 0.5 * Joint::length;
  ASSERT_GT(weight / k, 0.05);
  // phi of stiffness * phi = weight cos(phi) + moment
  const auto rest = [&](double stiffness, double moment) {
    double phi = 0.0;
    for (int i = 0; i < 60; ++i)
      phi -= (stiffness * phi - weight * std::cos(phi) - moment) /
             (stiffness + weight * std::sin(phi));
    return phi;
  };
  RodState state = drawn_state(model);
  EXPECT_EQ(settle(relaxed_for_long(model), state, down).errors, 0u);
  const double hung = rest((1.0 - fraction) * k, 0.0);
  EXPECT_NEAR(Joint::angle(state), hung, 1.0e-7);
  keep_hung_shape(model, state);

  // Nothing more is hung on it: it stays.
  Simulation still(model, settings_with(Integrator::bdf2));
  EXPECT_EQ(settle(still.model, still.state, down).errors, 0u);
  for (int i = 0; i < 200; ++i) still.step(0.01, down);
  EXPECT_NEAR(Joint::angle(still.state), hung, 1.0e-6);

  // A load answers to the full stiffness first, and to what is left of it in the end.
  Simulation sim(model, settings_with(Integrator::bdf2));
  const Load moment{0, 0.0, Vec3::Zero(), Vec3(0, load, 0)};
  sim.loads = {moment};
  EXPECT_EQ(settle(sim.model, sim.state, down, sim.loads).errors, 0u);
  EXPECT_NEAR(Joint::angle(sim.state), rest(k, load + fraction * k * hung), 1.0e-7);
  for (int i = 0; i < 1000; ++i) sim.step(0.01, down);
  const double sunk = rest((1.0 - fraction) * k, load);
  EXPECT_NEAR(Joint::angle(sim.state), sunk, 1.0e-5);
  EXPECT_GT(sunk, rest(k, load + fraction * k * hung) + 0.1);
}

// A joint that swings with relaxation, I phi'' = -K (phi - f q), q' = (phi - q)/tau, at a time
// fixed by its period, against a step 32 times smaller: second order.
double phi_after(int steps) {
  RodModel model = Joint::model();
  const double period = 1.0 / Joint::frequency(model);
  set_laws(model, [&](int) { return relaxing(0.4, 0.3 * period); });
  Simulation sim(model, settings_with(Integrator::bdf2));
  Joint::bend(sim.model, sim.state, 0.3);
  sim.state.joint_bias.assign(1, Vec3::Zero());  // relaxed at phi = 0 until then
  sim.state.joint_memory.assign(1, Vec3::Zero());
  for (int i = 0; i < steps; ++i) sim.step(1.3 * period / steps, no_gravity);
  return Joint::angle(sim.state);
}

TEST(Relaxation, SecondOrderInTime) {
  const double reference = phi_after(6400);
  double error[3];
  for (int i = 0; i < 3; ++i) error[i] = std::abs(phi_after(100 << i) - reference);
  RecordProperty("order", std::to_string(order(error[1], error[2])));
  EXPECT_GT(order(error[0], error[1]), 1.8);
  EXPECT_GT(order(error[1], error[2]), 1.8);
  EXPECT_LT(error[0], 0.05);
}

TEST(StructuralDamping, LossFactorIsFlatOverTheBand) {
  for (const double g : {0.02, 0.1, 0.3}) {
    JointLaw law;
    add_structural_damping(law, g);
    EXPECT_NEAR(modulus_at(law, 2.0).storage, 1.0, 1e-12);
    for (double f = 0.1; f <= 100.0; f *= 1.1)
      EXPECT_NEAR(modulus_at(law, f).loss_factor / g, 1.0, 0.03) << f << " Hz, g " << g;
    for (const JointBranch& branch : law.branches) EXPECT_GE(branch.share, 0.0);
    EXPECT_GT(law.elastic + law.deviation, 0.0);
  }
}

// Hysteretic damping, E (1 + i g): a mode's free decay is that of sqrt(1 + i g), zeta = g/2 but for
// g^2. First and second mode, 1.1 and 6.9 Hz.
TEST(StructuralDamping, RatioIsTheSameInTwoModes) {
  constexpr double g = 0.06;
  for (const int number : {1, 2}) {
    RodModel model = PeerCantilever::model(16);
    set_laws(model, [&](int) {
      JointLaw law;
      add_structural_damping(law, g);
      return law;
    });
    Simulation sim(model, settings_with(Integrator::bdf2));
    const CantileverMode mode(number, PeerCantilever::length);
    start_memory(sim.model, sim.state);
    set_mode_shape(sim.model, sim.state, mode, 1.0e-4, Vec3::UnitZ());
    const double f =
        mode.angular_frequency(PeerCantilever::bending, PeerCantilever::mass_per_length) / (2 * pi);
    Oscillation signal;
    for (int i = 0; signal.crossings() < 14 && i < 10000; ++i) {
      if (i > 0)
        signal.add(sim.state.time, modal_amplitude(sim.model, sim.state, mode, Vec3::UnitZ()));
      sim.step(1.0 / (300.0 * f), no_gravity);
    }
    RecordProperty("ratio_" + std::to_string(number), std::to_string(signal.damping_ratio()));
    EXPECT_NEAR(signal.damping_ratio() / (g / 2), 1.0, 0.05) << "mode " << number;
    const double storage = modulus_at(sim.model.laws[0], f).storage;
    EXPECT_NEAR(signal.frequency() / (f * std::sqrt(storage)), 1.0, 0.01) << "mode " << number;
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
