// hysteresis: M = (1 - ratio) K phi + ratio z, dz/dphi = K (1 - |z/moment|^exponent sign(dphi z)).
// With y = z/K and the reach r = moment/K, dy/dphi = 1 - |y/r|^exponent sign(dphi y), whose
// exponent 1 is a sum of exponentials: that is what the solver takes, exactly.
#include <gtest/gtest.h>

#include "plugins/cosserat/model/turn_frame.h"
#include "plugins/plant/plant_builder.h"
#include "tests/analytic/effects/joint_cases.h"
#include "tests/support/stem_plants.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double ratio = 0.4, reach = 0.15;  // 1; rad

RodModel remembering(double exponent, double damping_time = 0.0) {
  RodModel model = Joint::model(damping_time);
  set_laws(model, [&](int) {
    JointLaw law;
    add_hysteresis(law, ratio, ratio * Joint::stiffness(model) * reach, exponent);
    return law;
  });
  return model;
}

double slope_of(double y, double way, double exponent) {
  return 1.0 - std::copysign(std::pow(std::abs(y) / reach, exponent), way * y);
}

// y after a way from one phi to another, by small steps of the classical Runge-Kutta method.
double followed(double y, double from, double to, double exponent) {
  constexpr int steps = 20000;
  const double h = (to - from) / steps;
  const auto slope = [&](double at) { return slope_of(at, h, exponent); };
  for (int i = 0; i < steps; ++i) {
    const double k1 = slope(y), k2 = slope(y + h / 2 * k1), k3 = slope(y + h / 2 * k2),
                 k4 = slope(y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return y;
}

// Drives a held joint slowly from turn to turn; the moment at each of them.
std::vector<double> moments_along(const RodModel& given, const std::vector<double>& turns,
                                  int steps) {
  RodModel model = given;
  hold_direction(model);
  Simulation sim(model, settings_with(Integrator::backward_euler));
  EXPECT_EQ(settle(sim.model, sim.state, no_gravity).errors, 0u);
  std::vector<double> moments;
  double from = 0.0;
  for (const double to : turns) {
    for (int i = 1; i <= steps; ++i) {
      hold_at(sim.model, from + (to - from) * i / steps);
      for (int k = 0; k < 3; ++k) sim.step(1.0, no_gravity);
    }
    from = to;
    moments.push_back(Joint::moment(sim.model, sim.state));
  }
  return moments;
}

const std::vector<double> turns = {0.4, -0.3, 0.1, -0.05, 0.02, 0.5};

// The hold gives by a thousandth of K per K, which moves where it turns by up to 2e-6 of phi.
void expect_loops(double exponent, int steps, double within) {
  const RodModel model = remembering(exponent);
  const std::vector<double> found = moments_along(model, turns, steps);
  const double k = Joint::stiffness(model);
  double y = 0.0, from = 0.0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    y = followed(y, from, turns[i], exponent);
    from = turns[i];
    EXPECT_NEAR(found[i] / k, (1.0 - ratio) * from + ratio * y, within)
        << "turn " << i << ", exponent " << exponent;
    EXPECT_LE(std::abs(y), reach * (1.0 + 1e-12));
  }
}

TEST(Hysteresis, LoopsOfDahlAreExactInStepsOfAnySize) {
  for (const int steps : {1, 4, 100}) expect_loops(1.0, steps, 2.0e-6);
}

TEST(Hysteresis, LoopsOfBoucAndWen) {
  for (const double exponent : {1.5, 2.0, 5.0}) expect_loops(exponent, 400, 2.0e-5);
}

// Halving the steps divides the error by four, also at exponents that are no whole numbers.
TEST(Hysteresis, SecondOrderInTheWay) {
  const double expected = ratio * followed(0.0, 0.0, 0.12, 2.0) + (1.0 - ratio) * 0.12;
  const RodModel model = remembering(2.0);
  double error[2];
  for (int i = 0; i < 2; ++i)
    error[i] =
        std::abs(moments_along(model, {0.12}, 8 << i)[0] / Joint::stiffness(model) - expected);
  EXPECT_GT(order(error[0], error[1]), 1.7);
  EXPECT_LT(error[0], 1.0e-3);
}

// I phi'' = -M with y as a third unknown.
double swing(double start, double time, double inertia, double k, double exponent) {
  constexpr int steps = 100000;
  const double h = time / steps;
  Vec3 x(start, 0.0, 0.0);  // phi, phi', y: at the start the memory is bent by nothing
  const auto rate = [&](const Vec3& at) {
    return Vec3(at[1], -k * ((1.0 - ratio) * at[0] + ratio * at[2]) / inertia,
                at[1] * slope_of(at[2], at[1], exponent));
  };
  for (int i = 0; i < steps; ++i) {
    const Vec3 k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2),
               k4 = rate(x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return x[0];
}

double found_swing(const RodModel& model, double start, double time, int steps) {
  Simulation sim(model, settings_with(Integrator::bdf2));
  Joint::bend(sim.model, sim.state, start);
  start_memory(sim.model, sim.state);
  for (int i = 0; i < steps; ++i) sim.step(time / steps, no_gravity);
  return Joint::angle(sim.state);
}

TEST(Hysteresis, SwingsAsTheEquationSays) {
  for (const double exponent : {1.0, 2.0}) {
    const RodModel model = remembering(exponent);
    const double time = 3.2 / Joint::frequency(model), start = 0.4;
    const double expected =
        swing(start, time, Joint::inertia(model), Joint::stiffness(model), exponent);
    EXPECT_NEAR(found_swing(model, start, time, 4000), expected, 1.0e-3 * start) << exponent;
    EXPECT_GT(std::abs(expected - start * std::cos(2.0 * pi * 3.2)), 0.05 * start) << exponent;
  }
}

// A round stem does not know the axes of its frame.
TEST(Hysteresis, IsTheSameInEveryDirection) {
  const RodModel model = remembering(1.0);
  RodModel turned = model;
  turn_frame(turned, 0, 0.6);
  const double time = 2.0 / Joint::frequency(model);
  EXPECT_NEAR(found_swing(turned, 0.4, time, 400), found_swing(model, 0.4, time, 400), 1.0e-7);
}

// As the response of a joint whose memory is anything: one that is bent on in any direction.
TEST(Hysteresis, MomentIsTheSlopeOfTheEnergy) {
  for (const double exponent : {1.0, 1.7, 3.0}) {
    RodModel model = remembering(exponent);
    model.elements[0].bend_stiffness.x() *= 2.0;
    RodState state = drawn_state(model);
    Joint::bend(model, state, 0.2);
    start_memory(model, state);
    state.joint_memory[0] += Vec3(0.06, -0.09, 0.0);
    constexpr double h = 1e-6;
    for (const Vec3& phi :
         {Vec3(0.05, 0.3, 0.1), Vec3(-0.3, -0.1, 0.0), Vec3(0.2, 0.15, 0.0), Vec3(0, 0, 0)}) {
      const Vec3 moment = joint_response(model, state, 0, phi).moment;
      for (int i = 0; i < 3; ++i) {
        const auto energy = [&](double by) {
          return joint_response(model, state, 0, phi + by * Vec3::Unit(i)).energy;
        };
        EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), moment[i], 2e-7 * Joint::stiffness(model))
            << exponent << ", " << phi.transpose();
      }
    }
  }
}

// It settles as without what remembers, and rests there.
TEST(Hysteresis, SettlesWithoutTheMemory) {
  RodModel model = PeerCantilever::model(10), soft = model;
  set_laws(model, [&](int) {
    JointLaw law;
    add_hysteresis(law, ratio, 1.0e-4, 1.5);
    return law;
  });
  for (Element& element : soft.elements) element.bend_stiffness.head<2>() *= 1.0 - ratio;
  Simulation sim(model, settings_with(Integrator::bdf2));
  RodState expected = drawn_state(soft);
  EXPECT_EQ(settle(sim.model, sim.state, gravity).errors, 0u);
  settle(soft, expected, gravity);
  EXPECT_LT((sim.tip() - expected.position.back()).norm(), 1.0e-8);
  for (int i = 0; i < 100; ++i) sim.step(1.0 / 240.0, gravity);
  EXPECT_LT((sim.tip() - expected.position.back()).norm(), 1.0e-7);
}

// A cantilever that is let go: nearly every step finds its equilibrium of forces. For the exponent
// 1 that holds even where a step goes far beyond the reach, here 5e-4 rad; others have a kink
// there.
TEST(Hysteresis, NewtonConverges) {
  for (const auto& [exponent, limit] :
       {std::pair(1.0, 2.0e-5), std::pair(1.5, 2.0e-3), std::pair(4.0, 2.0e-3)}) {
    RodModel model = PeerCantilever::model(16);
    set_laws(model, [&, e = exponent, m = limit](int) {
      JointLaw law;
      add_hysteresis(law, 0.8, m, e);
      return law;
    });
    RodSettings settings = settings_with(Integrator::bdf2);
    settings.newton_iterations = 30;
    settings.tolerance = 1.0e-8;
    Simulation sim(model, settings);
    start_memory(sim.model, sim.state);
    int failed = 0;
    for (int i = 0; i < 300; ++i) failed += sim.step(1.0 / 240.0, gravity).errors != 0u;
    EXPECT_LE(failed, 6) << exponent;  // where joints turn, the slope jumps
    EXPECT_LT(sim.tip().z(), -0.05);
  }
}

TEST(Hysteresis, StandsBesideOtherLaws) {
  Diagnostics diagnostics;
  const auto file = plant::parse_plant(
      straight_stem_text +
          "effects:\n  - {name: hysteresis, moment: 0.01, exponent: 2, ratio: 0.3}\n"
          "  - {name: material_nonlinearity, coefficient: -0.1, k0: 3}\n"
          "  - {name: internal_friction, moment: 0.002, ratio: 0.2}\n",
      "p.plant.yaml", diagnostics);
  const auto built = file ? plant::build_plant(*file, {}, diagnostics) : std::nullopt;
  ASSERT_TRUE(built) << diagnostics.text();
  for (const JointLaw& law : built->model.laws) {
    ASSERT_EQ(law.branches.size(), 2u);
    EXPECT_EQ(law.branches[0].exponent, 2.0);
    EXPECT_NEAR(law.branches[0].limit, 0.003, 1e-15);
    EXPECT_EQ(law.branches[1].exponent, 0.0);
    EXPECT_NEAR(law.elastic, 0.5, 1e-15);
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
