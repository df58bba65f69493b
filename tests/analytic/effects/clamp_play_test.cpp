// clamp_play: no moment at the root below an angle a, K (phi - a) beyond.
#include <gtest/gtest.h>

#include "plugins/plant/plant_builder.h"
#include "tests/analytic/effects/joint_cases.h"
#include "tests/support/stem_plants.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double play = 0.1;  // rad

void loosen(RodModel& model, double angle = play) {
  model.laws.assign(model.elements.size(), JointLaw{});
  model.laws[0].term("clamp_play") = angle;
}

TEST(ClampPlay, MomentFollowsTheFormula) {
  RodModel model = Joint::model();
  loosen(model);
  const RodState state = drawn_state(model);
  const double k = Joint::stiffness(model);
  for (const Vec3& towards : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)})
    for (const double phi : {0.0, 0.05, 0.0999, 0.11, 0.4}) {
      const Vec3 moment = joint_response(model, state, 0, phi * towards).moment;
      EXPECT_LT((moment - k * std::max(0.0, phi - play) * towards).norm(), 1e-13 * k) << phi;
    }
  // Twist has no play.
  EXPECT_NEAR(joint_response(model, state, 0, Vec3(0, 0, 0.01)).moment.z(),
              0.01 * model.elements[0].bend_stiffness.z(), 1e-12);
}

TEST(ClampPlay, MomentIsTheSlopeOfTheEnergyWithUnequalStiffnesses) {
  RodModel model = Joint::model();
  model.elements[0].bend_stiffness.x() *= 3.0;
  loosen(model);
  const RodState state = drawn_state(model);
  constexpr double h = 1e-6;
  for (const Vec3& phi : {Vec3(0.03, 0.02, 0.1), Vec3(0.09, -0.05, 0.0), Vec3(-0.2, 0.3, 0.05)}) {
    const Vec3 moment = joint_response(model, state, 0, phi).moment;
    for (int i = 0; i < 3; ++i) {
      const auto energy = [&](double by) {
        return joint_response(model, state, 0, phi + by * Vec3::Unit(i)).energy;
      };
      EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), moment[i], 1e-7 * Joint::stiffness(model));
    }
  }
}

// A moment M turns the joint to a + M/K, from the unloaded shape and from far beyond.
TEST(ClampPlay, SettlesWhereTheSpringBearsTheLoad) {
  RodModel model = Joint::model();
  loosen(model);
  for (const double part : {1.0e-3, 0.2})
    for (const double start : {0.0, 0.5}) {
      const Load load{0, 0.0, Vec3::Zero(), Vec3(0, part * Joint::stiffness(model), 0)};
      RodState state = drawn_state(model);
      Joint::bend(model, state, start);
      EXPECT_EQ(settle(model, state, no_gravity, {&load, 1}).errors, 0u) << part << ", " << start;
      EXPECT_NEAR(Joint::angle(state), play + part, 1.0e-8) << part << ", " << start;
    }
}

// A cantilever under its weight falls by the play, and its root bears the rest.
TEST(ClampPlay, ACantileverSagsByThePlay) {
  RodModel model = PeerCantilever::model(10);
  RodState firm = drawn_state(model), loose = drawn_state(model);
  EXPECT_EQ(settle(model, firm, gravity).errors, 0u);
  loosen(model);
  EXPECT_EQ(settle(model, loose, gravity).errors, 0u);
  const double bend = strain_of(model, loose, 0).bend.norm();
  const double moment = joint_load(model, loose, 0).moment.norm();
  EXPECT_GT(bend, play);
  EXPECT_NEAR(moment / (model.elements[0].bend_stiffness.y() * (bend - play)), 1.0, 1.0e-9);
  EXPECT_LT(loose.position.back().z(), firm.position.back().z() - 0.02);
}

// I phi'' = -K max(0, |phi| - a) sign(phi): slower than the firm joint, and the slower the smaller
// the swing.
TEST(ClampPlay, SwingsAsTheEquationSays) {
  for (const double start : {0.15, 0.4}) {
    RodModel model = Joint::model();
    loosen(model);
    const double k = Joint::stiffness(model), time = 2.3 / Joint::frequency(model);
    const auto moment = [&](double, double phi, double) {
      return -k * std::copysign(std::max(0.0, std::abs(phi) - play), phi);
    };
    const double expected = runge_kutta(Joint::inertia(model), start, 0.0, time, 40000, moment);
    Simulation sim(model, settings_with(Integrator::bdf2));
    Joint::bend(sim.model, sim.state, start);
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) sim.step(time / steps, no_gravity);
    EXPECT_NEAR(Joint::angle(sim.state), expected, 1.0e-3 * start) << start;
    EXPECT_GT(std::abs(expected - start * std::cos(2.0 * pi * 2.3)), 0.05 * start);
  }
}

std::string build(const std::string& effects, RodModel* model = nullptr) {
  Diagnostics diagnostics;
  const auto file = plant::parse_plant(straight_stem_text + "effects: [" + effects + "]\n",
                                       "p.plant.yaml", diagnostics);
  const auto built = file ? plant::build_plant(*file, {}, diagnostics) : std::nullopt;
  if (built && model) *model = built->model;
  return diagnostics.text();
}

TEST(ClampPlay, IsAtTheRootAlone) {
  RodModel model;
  EXPECT_EQ(build("{name: clamp_play, angle: 0.05}", &model), "");
  for (int e = 0; e < model.size(); ++e)
    EXPECT_EQ(model.laws[e].terms_there() != 0u, model.elements[e].parent < 0) << e;
  EXPECT_EQ(build("{name: clamp_play, angle: 0}", &model), "");
  EXPECT_TRUE(model.laws.empty());
}

TEST(ClampPlay, NoOtherLawCarriesAMomentThere) {
  const std::string loose = "{name: clamp_play, angle: 0.05}";
  for (const std::string& other :
       {std::string("{name: relaxation, fraction: 0.1, time: 1}"),
        std::string("{name: material_nonlinearity, coefficient: 0.1, k0: 1}"),
        std::string("{name: yield, curvature: 3}"), loose}) {
    EXPECT_NE(build(loose + ", " + other).find("expected one of them"), std::string::npos) << other;
    EXPECT_NE(build(other + ", " + loose).find("expected one of them"), std::string::npos) << other;
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
