// Effects on the small-deflection flexibility of a cantilever under a tip
// force, integral (L - z)^2 / EI dz (Euler-Bernoulli, unit load method); of a
// discrete rod it is the sum of (L - z)^2 / k over its joints.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "plugins/plant/effect_reader.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/stem_plants.h"

namespace pedicel::plant {
namespace {

constexpr double length = 0.4;  // m

std::optional<BuiltPlant> built_with(const std::string& effects, Diagnostics& diagnostics) {
  const auto plant = parse_plant(straight_stem_text + effects, "p.plant.yaml", diagnostics);
  if (!plant) return std::nullopt;
  return build_plant(*plant, {}, diagnostics);
}

BuiltPlant with(const std::string& effects) {
  Diagnostics diagnostics;
  const auto plant = built_with(effects, diagnostics);
  EXPECT_TRUE(plant) << diagnostics.text();
  return plant.value_or(BuiltPlant{});
}

double flexibility(const BuiltPlant& plant) {
  double sum = 0.0;
  for (const auto& element : plant.model.elements) {
    const double arm = length - (element.drawn_position.z() - element.length);
    sum += arm * arm / element.bend_stiffness[0];
  }
  return sum;
}

// The integral for EI = 1 x relative(z).
double integral(const std::function<double(double)>& relative) {
  constexpr int pieces = 100000;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double z = (i + 0.5) * length / pieces;
    sum += (length - z) * (length - z) / relative(z) * length / pieces;
  }
  return sum;
}

double mass_of(const BuiltPlant& plant) {
  double sum = 0.0;
  for (const auto& element : plant.model.elements) sum += element.mass;
  return sum;
}

const auto uniform = [](double) { return 1.0; };

TEST(Effects, StiffnessGradientFollowsTheCurve) {
  const double plain = flexibility(with(""));
  for (const double gradient : {0.5, -1.0}) {
    const double got = flexibility(with(
        "effects: [{name: stiffness_gradient, gradient: " + std::to_string(gradient) + "}]\n"));
    const double expected =
        integral([&](double z) { return 1.0 + gradient * (z / length - 0.5); }) / integral(uniform);
    EXPECT_NEAR(got / plain / expected, 1.0, 1e-3);
  }
}

TEST(Effects, WeakSegmentBendsMore) {
  const BuiltPlant plain = with("");
  const double stiffness = plain.model.elements[0].section.bend1;
  for (const double at : {0.1, 0.5}) {
    const auto weak = [&](double z) { return std::abs(z - at * length) < 0.015 ? 0.3 : 1.0; };
    const double extra = flexibility(with("effects: [{name: weak_segment, factor: 0.3, length: "
                                          "0.03, where: {curve: stem, at: " +
                                          std::to_string(at) + "}}]\n")) -
                         flexibility(plain);
    EXPECT_NEAR(extra * stiffness / (integral(weak) - integral(uniform)), 1.0, 5e-3);
  }
}

TEST(Effects, BaseComplianceIsASpringInSeries) {
  const double extra = flexibility(with("effects: [{name: base_compliance, stiffness: 2.5}]\n")) -
                       flexibility(with(""));
  EXPECT_NEAR(extra, length * length / 2.5, 1e-9);
}

TEST(Effects, FactorsAndMasses) {
  const BuiltPlant plain = with("");
  EXPECT_NEAR(flexibility(with("effects: [{name: youngs_modulus, factor: 2}]\n")),
              0.5 * flexibility(plain), 1e-9);
  EXPECT_NEAR(mass_of(with("effects: [{name: density, factor: 3}]\n")), 3.0 * mass_of(plain),
              1e-12);
  EXPECT_NEAR(mass_of(with("effects: [{name: extra_mass, mass: 0.015, where: "
                           "{curve: stem, at: 0.7}}]\n")),
              0.015 + mass_of(plain), 1e-12);
  EXPECT_EQ(with("effects: [{name: mass_damping, rate: 2}]\n").model.elements[3].mass_damping, 2.0);
  EXPECT_NEAR(with("effects: [{name: damping_time, factor: 2}]\n").model.elements[3].damping_time,
              0.02, 1e-15);
}

}  // namespace
}  // namespace pedicel::plant
