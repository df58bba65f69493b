// Effects that are laws of joints and air, out of a plant file: what each sets, and for whom. That
// the laws do what they say is tested with the rods (tests/analytic/effects).
#include <gtest/gtest.h>

#include <cmath>

#include "plugins/cosserat/laws/joint_terms.h"
#include "plugins/cosserat/solver/detachment.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/stem_plants.h"

namespace pedicel::plant {
namespace {

// Two curves: a stem of 0.4 m along z, and a branch of 0.2 m from its middle along x; elements of
// 20 mm.
std::optional<BuiltPlant> built_with(const std::string& effects, Diagnostics& diagnostics) {
  const auto plant = parse_plant(
      straight_stem_text +
          "  - {name: branch, interpolation: linear, points: [[0, 0, 0.2], [0.2, 0, 0.2]],"
          " radius: 0.002}\n"
          "fruits:\n"
          "  - {name: apple, curve: branch, at: 1, radius: 0.01, density: 900, detach: {force: "
          "5}}\n" +
          effects,
      "p.plant.yaml", diagnostics);
  if (!plant) return std::nullopt;
  return build_plant(*plant, {}, diagnostics);
}

BuiltPlant with(const std::string& effects) {
  Diagnostics diagnostics;
  const auto plant = built_with("effects: [" + effects + "]\n", diagnostics);
  EXPECT_TRUE(plant) << diagnostics.text();
  return plant.value_or(BuiltPlant{});
}

std::string refusal_of(const std::string& effects) {
  Diagnostics diagnostics;
  EXPECT_FALSE(built_with("effects: [" + effects + "]\n", diagnostics));
  return diagnostics.text();
}

// The first two elements of the stem, and one in the branch.
struct Sample {
  int clamp = -1, inner = -1, branch = -1;
  explicit Sample(const BuiltPlant& plant) {
    for (const BuiltPlant::Span& span : plant.spans) {
      if (span.curve == 1 && span.arc_near > 0.05) branch = span.element;
      if (span.curve == 1) continue;
      if (span.arc_near == 0.0) clamp = span.element;
      if (std::abs(span.arc_near - 0.02) < 1e-6) inner = span.element;
    }
  }
};

TEST(Laws, NonlinearityIsInCurvature) {
  const BuiltPlant plant = with("{name: material_nonlinearity, coefficient: -0.2, k0: 2}");
  const Sample at(plant);
  // phi0 = k0 l_bar: 2 x 0.02 between segments, 2 x 0.01 at the clamp.
  EXPECT_NEAR(plant.model.laws[at.inner].terms.at(laws::first_number("material_nonlinearity")),
              -0.2 / (0.04 * 0.04), 1e-6);
  EXPECT_NEAR(plant.model.laws[at.clamp].terms.at(laws::first_number("material_nonlinearity")),
              -0.2 / (0.02 * 0.02), 1e-6);
}

TEST(Laws, RelaxationAndCreepAreTheSameLaw) {
  for (const std::string name : {"relaxation", "creep"}) {
    const BuiltPlant plant = with("{name: " + name + ", fraction: 0.3, time: 40}");
    const cosserat::JointLaw& law = plant.model.laws[Sample(plant).branch];
    ASSERT_EQ(law.branches.size(), 1u);
    EXPECT_EQ(law.branches[0].share, 0.3);
    EXPECT_EQ(law.branches[0].time, 40.0);
    EXPECT_FALSE(law.branches[0].from_unloaded);
    EXPECT_EQ(law.elastic, 1.0);
  }
  const BuiltPlant plant = with("{name: creep, fraction: 0.3, time: 40, start: unloaded}");
  EXPECT_TRUE(plant.model.laws[0].branches[0].from_unloaded);
}

TEST(Laws, SlidersSlipAtAMomentOrACurvature) {
  const BuiltPlant plant = with("{name: internal_friction, curvature: 0.5, ratio: 0.2}");
  const Sample at(plant);
  const double k = plant.model.elements[at.inner].bend_stiffness.x();
  EXPECT_NEAR(plant.model.laws[at.inner].branches[0].limit, 0.2 * k * 0.5 * 0.02, 1e-12);
  EXPECT_NEAR(plant.model.laws[at.inner].elastic, 0.8, 1e-12);
  const BuiltPlant other = with("{name: internal_friction, moment: 0.003, ratio: 0.2}");
  EXPECT_EQ(other.model.laws[at.inner].branches[0].limit, 0.003);
}

TEST(Laws, WhereGivesThemToOneCurve) {
  const BuiltPlant plant = with(
      "{name: yield, curvature: 3, where: {curve: branch, at: 0}}, "
      "{name: leaf_drag, drag_area: 0.01, where: {curve: stem, at: 0}}");
  const Sample at(plant);
  EXPECT_TRUE(plant.model.laws[at.inner].branches.empty());
  ASSERT_EQ(plant.model.laws[at.branch].branches.size(), 1u);
  const double k = plant.model.elements[at.branch].bend_stiffness.x();
  EXPECT_NEAR(plant.model.laws[at.branch].branches[0].limit, k * 3 * 0.02, 1e-12);
  EXPECT_EQ(plant.model.air[at.inner].drag_area, 0.01);
  EXPECT_EQ(plant.model.air[at.branch].drag_area, 0.0);
}

// Areas and velocities add: a plant has one air.
TEST(Laws, WindGustAndLeavesShareTheAir) {
  const BuiltPlant plant = with(
      "{name: wind, velocity: [1, 0, 0], drag_area: 0.02}, {name: leaf_drag, drag_area: 0.03}, "
      "{name: gust, velocity: [0, 2, 0], drag_area: 0.01, frequency: 0.7, amplitude: 0.3}");
  const cosserat::SegmentAir& air = plant.model.air[0];
  EXPECT_NEAR(air.drag_area, 0.06, 1e-12);
  EXPECT_LT((air.velocity - Vec3(1, 2, 0)).norm(), 1e-12);
  EXPECT_LT((air.gust - Vec3(0, 0.6, 0)).norm(), 1e-12);
  EXPECT_EQ(plant.model.gust_frequency, 0.7);
}

TEST(Laws, DriftIsThePlants) {
  EXPECT_EQ(with("{name: stiffness_drift, rate: -1e-5}").model.stiffness_drift, -1e-5);
}

TEST(Laws, StructuralDampingIsABankOfDashpots) {
  const BuiltPlant plant = with("{name: structural_damping, loss_factor: 0.1}");
  for (const double f : {0.01, 0.1, 5.0, 100.0})
    EXPECT_NEAR(modulus_at(plant.model.laws[0], f).loss_factor, 0.1, 0.003) << f;
  EXPECT_NEAR(modulus_at(plant.model.laws[0], 2.0).storage, 1.0, 1e-12);
  const BuiltPlant other = with("{name: structural_damping, loss_factor: 0.1, frequency: 0.4}");
  EXPECT_NEAR(modulus_at(other.model.laws[0], 0.4).storage, 1.0, 1e-12);
}

// First frequencies in the two directions are as sqrt(ratio): static stiffness as ratio.
TEST(Laws, AnisotropyMakesOneDirectionStiffer) {
  constexpr double ratio = 1.7;
  const Vec3 direction = Vec3(0.6, 0.8, 0);
  const BuiltPlant plain = with("");
  const BuiltPlant plant =
      with("{name: anisotropy, ratio: 1.7, direction: [0.6, 0.8, 0], where: {curve: stem, at: 0}}");
  const auto tip_moved = [](const BuiltPlant& built, const Vec3& force) {
    const PlacedPoint tip = built.locate(0, 1.0);
    const cosserat::Load load{tip.element, tip.back, force, Vec3::Zero()};
    cosserat::RodState state = cosserat::drawn_state(built.model);
    cosserat::settle(built.model, state, Vec3::Zero(), {&load, 1});
    return Vec3(state.position[tip.element] - built.model.elements[tip.element].drawn_position);
  };
  const Vec3 push = 1e-4 * direction, across = 1e-4 * Vec3(-0.8, 0.6, 0);
  const Vec3 soft = tip_moved(plain, push);
  const Vec3 stiff = tip_moved(plant, push);
  // Shear, 1e-4 of the deflection, is left as it was.
  EXPECT_NEAR(soft.norm() / stiff.norm(), ratio, 1e-3);
  EXPECT_LT(std::abs(stiff.dot(across)), 1e-6 * stiff.norm() * across.norm());
  EXPECT_NEAR(tip_moved(plant, across).norm() / soft.norm(), 1.0, 1e-6);
  // At 45 degrees to the axes the plant moves aside.
  const Vec3 both = tip_moved(plant, 0.5 * (push + across));
  EXPECT_GT(std::abs(both.normalized().dot((push - across).normalized())), 0.1);
}

TEST(Laws, DetachmentLawReplacesThresholds) {
  const BuiltPlant plant =
      with("{name: detachment_law, force: 4, moment: 0.02, exponents: [1, 3, 2]}");
  ASSERT_TRUE(plant.model.fruits[0].law);
  const cosserat::DetachmentLaw& law = *plant.model.fruits[0].law;
  EXPECT_EQ(law.force, 4.0);
  EXPECT_EQ(law.torsion, cosserat::Thresholds::never);
  EXPECT_EQ(law.exponents, Vec3(1, 3, 2));
  cosserat::RodState state = cosserat::drawn_state(plant.model);
  const int e = plant.model.fruits[0].element;
  state.orientation[e] = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitY())) * state.orientation[e];
  const cosserat::JointLoad load = cosserat::joint_load(plant.model, state, e);
  EXPECT_NEAR(cosserat::margin_used(plant.model, state, 0),
              load.force.norm() / 4.0 + std::pow(load.moment.head<2>().norm() / 0.02, 3), 1e-12);
  EXPECT_FALSE(
      with("{name: detachment_law, force: 4, where: {curve: stem, at: 0}}").model.fruits[0].law);
}

TEST(Laws, StackOnOneJoint) {
  const BuiltPlant plant = with(
      "{name: yield, curvature: 4}, {name: internal_friction, curvature: 0.5, ratio: 0.2}, "
      "{name: relaxation, fraction: 0.3, time: 1}, {name: structural_damping, loss_factor: 0.05}");
  const cosserat::JointLaw& law = plant.model.laws[3];
  ASSERT_EQ(law.branches.size(), 11u);
  EXPECT_TRUE(std::isfinite(law.branches[0].limit));
  EXPECT_TRUE(std::isfinite(law.branches[1].limit));
  EXPECT_FALSE(std::isfinite(law.branches[2].limit));
  EXPECT_EQ(law.elastic, 0.0) << "what was elastic yields";
}

TEST(Laws, RefusesWhatDoesNotGoTogether) {
  EXPECT_NE(refusal_of("{name: yield, curvature: 4}, {name: yield, curvature: 5}")
                .find("p.plant.yaml:13:40: error: yield twice on one curve, expected it once"),
            std::string::npos)
      << refusal_of("{name: yield, curvature: 4}, {name: yield, curvature: 5}");
  EXPECT_NE(refusal_of(
                "{name: yield, curvature: 4}, {name: material_nonlinearity, coefficient: 1, k0: 1}")
                .find("error: yield and material_nonlinearity on one curve, expected one of them"),
            std::string::npos);
  EXPECT_NE(refusal_of("{name: internal_friction, ratio: 0.6, moment: 1}, "
                       "{name: internal_friction, ratio: 0.4, moment: 2}")
                .find("leave no elastic stiffness, expected the ratios and fractions"),
            std::string::npos);
  EXPECT_NE(
      refusal_of("{name: gust, velocity: [1, 0, 0], drag_area: 0.1, frequency: 1, amplitude: 0.2}, "
                 "{name: gust, velocity: [1, 0, 0], drag_area: 0.1, frequency: 2, amplitude: 0.2}")
          .find("error: a second gust of another frequency, expected gusts of one frequency"),
      std::string::npos);
  EXPECT_NE(refusal_of("{name: creep, fraction: 0.1, time: 9, start: later}")
                .find("error: start is \"later\", expected settled or unloaded"),
            std::string::npos);
  EXPECT_NE(refusal_of("{name: detachment_law}")
                .find("error: detachment_law gives none of force, moment and torsion, expected"),
            std::string::npos);
  EXPECT_NE(refusal_of("{name: detachment_law, force: 1, exponents: [1, 0, 1]}")
                .find("error: exponents has 0.000000, expected numbers above 0"),
            std::string::npos);
  EXPECT_NE(refusal_of("{name: anisotropy, ratio: 2, direction: [0, 0, 0]}")
                .find("error: anisotropy has a direction of length 0, expected a direction"),
            std::string::npos);
}

}  // namespace
}  // namespace pedicel::plant
