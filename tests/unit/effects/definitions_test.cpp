// What holds for every effect, whichever they are: a definition says all that others ask for, an
// effect of no size does nothing, and fits start from values that can be simulated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/stem_plants.h"

namespace pedicel::effects {
namespace {

constexpr double big = 1.0e12;  // stands for infinity

// A stem of 0.4 m along z, and a branch of 0.2 m from its middle along x, with a fruit.
plant::PlantFile drawn() {
  Diagnostics diagnostics;
  const auto file = plant::parse_plant(
      straight_stem_text +
          "  - {name: branch, interpolation: linear, points: [[0, 0, 0.2], [0.2, 0, 0.2]],"
          " radius: 0.002}\n"
          "fruits:\n"
          "  - {name: apple, curve: branch, at: 1, radius: 0.01, density: 900, detach: {force: "
          "5}}\n",
      "p.plant.yaml", diagnostics);
  EXPECT_TRUE(file) << diagnostics.text();
  return file.value_or(plant::PlantFile{});
}

// Numbers as a new effect has them, but for those in which it vanishes.
plant::Effect without_size(const EffectDefinition& definition) {
  plant::Effect effect;
  effect.name = definition.name;
  if (definition.needs_place) effect.place = plant::CurvePlace{"branch", 0.5, {}};
  for (const EffectParameter& one : definition.parameters) {
    if (!one.required && !one.offered) continue;
    if (one.size == 0) {
      effect.words[one.name] = one.words.empty() ? "m1" : one.words.front();
      continue;
    }
    std::vector<double> value = one.first;
    for (double& x : value) {
      if (one.vanishes == Vanishes::at_zero) x = 0.0;
      if (one.vanishes == Vanishes::at_one) x = 1.0;
      if (one.vanishes == Vanishes::at_infinity) x = big;
    }
    effect.numbers[one.name] = value;
  }
  return effect;
}

// Where a plant is that was let go under a gravity that pulls it aside.
std::vector<Vec3> moved(const plant::PlantFile& file) {
  Diagnostics diagnostics;
  const auto built = plant::build_plant(file, {}, diagnostics);
  EXPECT_TRUE(built) << diagnostics.text();
  if (!built) return {};
  cosserat::RodSettings settings;
  settings.newton_iterations = 20;
  cosserat::DirectSolver solver(settings, built->model);
  cosserat::RodState state = cosserat::drawn_state(built->model);
  cosserat::StepInput input;
  input.dt = 1.0 / 240.0;
  input.gravity = Vec3(4.0, 2.0, -9.0);
  for (int i = 0; i < 40; ++i) solver.step(built->model, state, input);
  return state.position;
}

class Effects : public ::testing::TestWithParam<std::string> {
 protected:
  const EffectDefinition& definition() const { return *find_effect(GetParam()); }
};

TEST_P(Effects, SayAllThatOthersAskFor) {
  const EffectDefinition& d = definition();
  EXPECT_FALSE(d.plain_name.empty());
  EXPECT_FALSE(d.sentence.empty());
  std::set<std::string> names;
  for (const EffectParameter& one : d.parameters) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_FALSE(one.sentence.empty()) << one.name;
    EXPECT_FALSE(one.unit.empty()) << one.name;
    if (one.size == 0) continue;
    EXPECT_EQ(one.first.size(), std::size_t(one.size)) << one.name;
    for (const double x : one.first)
      if (one.size == 1) {
        EXPECT_TRUE(io::within(x, one.bounds)) << one.name << " begins with " << x;
      }
  }
  for (const std::string& special : d.special_cases) EXPECT_TRUE(find_effect(special)) << special;
  for (const Limit& limit : d.limits) {
    EXPECT_TRUE(d.find(limit.parameter)) << limit.parameter;
    EXPECT_TRUE(find_effect(limit.becomes)) << limit.becomes;
  }
  // A fit of it shrinks one of its numbers until nothing is left. A law of detachment has none.
  const bool has_size = std::ranges::any_of(
      d.parameters, [](const EffectParameter& p) { return p.vanishes != Vanishes::never; });
  EXPECT_TRUE(has_size || d.home == Home::stalk);
}

TEST_P(Effects, OfNoSizeDoNothing) {
  const EffectDefinition& d = definition();
  const plant::Effect effect = without_size(d);
  if (std::holds_alternative<GripChange>(d.change)) {
    GripState grip;
    grip.stiffness = big;
    apply_to_grip(effect, grip);
    EXPECT_EQ(grip.stiffness, big);
    EXPECT_EQ(grip.slip_distance, 0.0);
  } else if (std::holds_alternative<SensorChange>(d.change)) {
    SensorState sensor;
    sensor.markers = {"m1"};
    sensor.offset = {Vec3::Zero()};
    apply_to_sensor(effect, sensor);
    EXPECT_EQ(sensor.offset[0], Vec3(0, 0, 0));
    EXPECT_EQ(sensor.delay, 0.0);
    EXPECT_EQ(sensor.marker_lag, 0.0);
    EXPECT_EQ(sensor.force_lag, 0.0);
    EXPECT_TRUE(sensor.frame.isIdentity(1e-15));
    EXPECT_EQ(sensor.gain, 1.0);
    EXPECT_TRUE(sensor.force_offset.isZero());
  } else if (std::holds_alternative<ModelChange>(d.change) && d.home != Home::stalk) {
    plant::PlantFile file = drawn();
    const std::vector<Vec3> plain = moved(file);
    file.effects = {effect};
    const std::vector<Vec3> with = moved(file);
    ASSERT_EQ(with.size(), plain.size());
    double far = 0.0;
    for (std::size_t e = 0; e < plain.size(); ++e) far = std::max(far, (with[e] - plain[e]).norm());
    EXPECT_LT(far, 1e-6);  // it moves by centimetres; laws are solved to the solver's tolerance
  }
}

TEST_P(Effects, StartWhereTheyCanBeSimulated) {
  const EffectDefinition& d = definition();
  if (!d.starts) return;
  plant::PlantFile file = drawn();
  const StartContext context{file,
                             {.length = 0.4,
                              .mass = 0.02,
                              .root_stiffness = 0.05,
                              .curvature = 2.0,
                              .duration = 4.0,
                              .sample_time = 0.01},
                             60.0,
                             {"m1", "m2"},
                             {{"push", 2.0, 0.0}},
                             true};
  const std::vector<Start> starts = d.starts(context);
  ASSERT_FALSE(starts.empty());
  for (const Start& start : starts) {
    EXPECT_EQ(start.effect().name, d.name);
    bool sized = false;
    for (const FreeParameter& free : start.free()) {
      EXPECT_LT(free.low, free.high) << free.name;
      sized = sized || free.vanishes != Vanishes::never;
      if (free.name == "at" || free.name == "heading") continue;
      ASSERT_TRUE(d.find(free.name)) << free.name;
      EXPECT_EQ(free.unit, d.find(free.name)->unit);
    }
    EXPECT_TRUE(sized) << "nothing that a fit could shrink";
    if (!std::holds_alternative<ModelChange>(d.change)) continue;
    file.effects = {start.effect()};
    Diagnostics diagnostics;
    EXPECT_TRUE(plant::build_plant(file, {}, diagnostics)) << diagnostics.text();
  }
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const EffectDefinition& one : effect_definitions()) names.push_back(one.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, Effects, ::testing::ValuesIn(all_names()),
                         [](const auto& named) { return named.param; });

TEST(EffectList, HasEachNameOnce) {
  std::set<std::string> names;
  for (const EffectDefinition& one : effect_definitions())
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
  EXPECT_GE(names.size(), 30u);
}

TEST(EffectList, HasAFactorForEachNumberOfTheMaterialWithARole) {
  int roles = 0;
  for (const plant::MaterialKey& key : plant::material_keys) {
    if (key.role == plant::MaterialRole::none) continue;
    ++roles;
    EXPECT_EQ(&plant::material_key(key.role), &key) << "two numbers have one role";
    EXPECT_EQ(material_factor(key.role).name, key.name);
    EXPECT_TRUE(key.known_to) << key.name;
  }
  EXPECT_EQ(material_factors().size(), static_cast<std::size_t>(roles));
  EXPECT_EQ(plant::count_roles(), roles);
}

TEST(EffectList, HasOneSpringForJunctionsOfOtherSolvers) {
  std::vector<std::string> named;
  for (const EffectDefinition& one : effect_definitions()) {
    if (!one.at_junction) continue;
    const Start start = one.at_junction("branch", 2.0);
    named.push_back(one.name);
    EXPECT_EQ(start.effect().name, one.name);
    EXPECT_EQ(start.effect().place->curve, "branch");
    // The least that a fit may come to is what was asked for.
    EXPECT_EQ(start.free().front().low, 2.0);
  }
  EXPECT_EQ(named.size(), 1u);
}

TEST(EffectList, RanksWhatASymptomSpeaksFor) {
  EXPECT_EQ(spoken_for("junction_kink"),
            (std::vector<std::string>{"attachment_compliance", "weak_segment"}));
  EXPECT_EQ(spoken_for("damping_by_amplitude").front(), "leaf_drag");
  EXPECT_TRUE(spoken_for("no such symptom").empty());
}

TEST(EffectList, KnowsFamiliesAndSpecialCases) {
  EXPECT_TRUE(same_family("creep", "relaxation"));
  EXPECT_FALSE(same_family("latency", "stiffness_drift"));  // of no family
  EXPECT_TRUE(same_family("latency", "latency"));
  EXPECT_TRUE(is_special_case("leaf_drag", "wind"));
  EXPECT_FALSE(is_special_case("wind", "leaf_drag"));
  EXPECT_EQ(unit_of("grip_compliance", "stiffness"), "N/m");
  EXPECT_EQ(unit_of("base_compliance", "stiffness"), "N m/rad");
}

}  // namespace
}  // namespace pedicel::effects
