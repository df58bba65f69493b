// asymmetry: M_a = EI k_a (1 + c k_a / sqrt(k0^2 + k_a^2)) about an axis a alone.
#include <gtest/gtest.h>

#include <cmath>

#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/stem_plants.h"

namespace pedicel::plant {
namespace {

constexpr double k0 = 2.0;  // 1/m

// A straight stem of 0.4 m along z with c = 0.5 about x.
BuiltPlant stem(const std::string& more = "") {
  Diagnostics diagnostics;
  const auto file = parse_plant(
      straight_stem_text + "effects: [{name: asymmetry, coefficient: 0.5, axis: [1, 0, 0], k0: 2}" +
          more + "]\n",
      "p.plant.yaml", diagnostics);
  EXPECT_TRUE(file) << diagnostics.text();
  const auto built = file ? build_plant(*file, {}, diagnostics) : std::nullopt;
  EXPECT_TRUE(built) << diagnostics.text();
  return built.value_or(BuiltPlant{});
}

// A joint inside of the stem, and the length that its bend is spread over.
constexpr int inner = 5;
double length_of(const BuiltPlant& plant) {
  return plant.model.elements[inner].length;
}

// phi about x and y of the world as a bend of that element's frame, and a moment back.
Vec3 in_frame(const BuiltPlant& plant, const Vec3& world) {
  return plant.model.elements[inner].drawn_rotation.conjugate() * world;
}

// M_a / (EI k_a) follows the formula on either side, and M is none about the other axis.
TEST(Asymmetry, MomentFollowsTheFormula) {
  const BuiltPlant plant = stem();
  const cosserat::RodState state = cosserat::drawn_state(plant.model);
  const double stiffness = plant.model.elements[inner].bend_stiffness.x();
  for (const double k : {-20.0, -2.0, -0.1, 0.1, 2.0, 20.0}) {
    const double phi = k * length_of(plant);
    const Vec3 moment =
        plant.model.elements[inner].drawn_rotation *
        cosserat::joint_response(plant.model, state, inner, in_frame(plant, phi * Vec3::UnitX()))
            .moment;
    const double expected = stiffness * phi * (1.0 + 0.5 * k / std::sqrt(k0 * k0 + k * k));
    EXPECT_NEAR(moment.x(), expected, 1e-12 * std::abs(expected)) << k;
    EXPECT_NEAR(moment.y(), 0.0, 1e-12 * std::abs(expected)) << k;
    const Vec3 across =
        cosserat::joint_response(plant.model, state, inner, in_frame(plant, phi * Vec3::UnitY()))
            .moment;
    EXPECT_NEAR(across.norm(), stiffness * std::abs(phi), 1e-12 * std::abs(expected)) << k;
  }
}

// The moment is the slope of the energy, by central differences.
TEST(Asymmetry, MomentIsTheSlopeOfTheEnergy) {
  const BuiltPlant plant = stem();
  const cosserat::RodState state = cosserat::drawn_state(plant.model);
  const auto energy = [&](const Vec3& phi) {
    return cosserat::joint_response(plant.model, state, inner, phi).energy;
  };
  constexpr double h = 1e-6;
  for (const Vec3& phi : {Vec3(0.03, 0.01, 0.02), Vec3(-0.2, 0.1, 0.0), Vec3(0.5, -0.4, 0.1)}) {
    const Vec3 moment = cosserat::joint_response(plant.model, state, inner, phi).moment;
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = h * Vec3::Unit(i);
      EXPECT_NEAR((energy(phi + step) - energy(phi - step)) / (2 * h), moment[i],
                  1e-7 * moment.norm());
    }
  }
}

// The solver bends a stem with a moment at its tip so that every joint carries it.
double curvature_under(const BuiltPlant& plant, double moment) {
  cosserat::RodSettings settings;
  settings.newton_iterations = 50;
  cosserat::DirectSolver solver(settings, plant.model);
  cosserat::RodState state = cosserat::drawn_state(plant.model);
  const int tip = plant.model.size() - 1;
  const cosserat::Load load{tip, 0.0, Vec3::Zero(), moment * Vec3::UnitX()};
  cosserat::StepInput input;
  input.dt = 0.5;  // heavily damped by backward Euler: it comes to rest
  input.gravity = Vec3::Zero();
  input.loads = {&load, 1};
  for (int i = 0; i < 400; ++i) solver.step(plant.model, state, input);
  const Vec3 turn = plant.model.elements[inner].drawn_rotation *
                    cosserat::strain_of(plant.model, state, inner).bend;
  return turn.x() / length_of(plant);
}

TEST(Asymmetry, StemBendsLessTowardsOneSide) {
  const BuiltPlant plant = stem();
  const double ei = plant.model.elements[inner].bend_stiffness.x() * length_of(plant);
  for (const double k : {1.5, -1.5}) {
    const double moment = ei * k * (1.0 + 0.5 * k / std::sqrt(k0 * k0 + k * k));
    EXPECT_NEAR(curvature_under(plant, moment), k, 1e-6) << k;
  }
}

TEST(Asymmetry, RefusesWhatItCannotBe) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_plant(straight_stem_text +
                               "effects: [{name: asymmetry, coefficient: 0.95, axis: [1, 0, 0], "
                               "k0: 2}]\n",
                           "p.plant.yaml", diagnostics));
  EXPECT_NE(
      diagnostics.text().find("coefficient is \"0.95\", expected a number between -0.9 and 0.9"),
      std::string::npos)
      << diagnostics.text();
  Diagnostics none;
  EXPECT_FALSE(parse_plant(straight_stem_text +
                               "effects: [{name: asymmetry, coefficient: 0.5, axis: [0, 0, 0], "
                               "k0: 2}]\n",
                           "p.plant.yaml", none));
  EXPECT_NE(none.text().find("axis of length 0"), std::string::npos) << none.text();
}

}  // namespace
}  // namespace pedicel::plant
