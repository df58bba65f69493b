// What holds for every effect of a scene, whichever they are: a definition says all that others ask
// for, an effect of no size does nothing, and fits start from numbers that it has.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {
namespace {

using effects::EffectParameter;
using effects::Vanishes;

class SceneDefinitions : public testing::TestWithParam<std::string> {
 protected:
  const SceneEffectDefinition& definition() const { return *find_scene_effect(GetParam()); }

  static Experiment experiment(const ArmAtStem& at) {
    at.write_all();
    Experiment read = at.read();
    // A trial that shows what only arms with commands and fruits that come off show.
    read.trials.front().follows_commands = true;
    read.trials.front().events.push_back({0.5, "detached", "apple", "finger"});
    read.plants.front().file.fruits.resize(1);
    return read;
  }
};

// All numbers of a definition where they do nothing, and the words that it needs.
plant::Effect without_size(const SceneEffectDefinition& definition, const SceneState& nominal) {
  plant::Effect effect;
  effect.name = definition.name;
  for (const EffectParameter& one : definition.parameters) {
    if (one.size == 0) {
      if (one.required) effect.words[one.name] = "turn";
      continue;
    }
    std::vector<double> value = one.first;
    for (double& x : value) {
      if (one.vanishes == Vanishes::at_zero) x = 0.0;
      if (one.vanishes == Vanishes::at_one) x = 1.0;
      if (one.vanishes == Vanishes::at_nominal) x = nominal.coupling.friction;
    }
    effect.numbers[one.name] = value;
  }
  return effect;
}

bool vanishes_at_infinity(const SceneEffectDefinition& definition) {
  return std::ranges::any_of(definition.parameters, [](const EffectParameter& one) {
    return one.vanishes == Vanishes::at_infinity;
  });
}

void expect_same(const SceneState& a, const SceneState& b) {
  EXPECT_EQ(a.coupling.friction, b.coupling.friction);
  EXPECT_EQ(a.coupling.contact_stiffness, b.coupling.contact_stiffness);
  EXPECT_EQ(a.coupling.fruit_stiffness, b.coupling.fruit_stiffness);
  EXPECT_EQ(a.friction_of_link, b.friction_of_link);
  for (std::size_t p = 0; p < a.plants.size(); ++p) {
    EXPECT_EQ(a.plants[p].offset, b.plants[p].offset);
    EXPECT_EQ(a.plants[p].yaw, b.plants[p].yaw);
    EXPECT_EQ(a.plants[p].fruit_mass, b.plants[p].fruit_mass);
    EXPECT_EQ(a.plants[p].threshold, b.plants[p].threshold);
  }
  EXPECT_EQ(a.tool_offset, b.tool_offset);
  EXPECT_EQ(a.tool_rotation, b.tool_rotation);
  EXPECT_EQ(a.joint_offset, b.joint_offset);
  EXPECT_EQ(a.robot_delay, b.robot_delay);
  EXPECT_EQ(a.joint_stiffness, b.joint_stiffness);
  EXPECT_EQ(a.coulomb, b.coulomb);
  EXPECT_EQ(a.viscous, b.viscous);
  EXPECT_EQ(a.payload, b.payload);
  EXPECT_EQ(a.tracking_lag, b.tracking_lag);
  for (std::size_t w = 0; w < a.gauges.size(); ++w) {
    EXPECT_EQ(a.gauges[w].gain, b.gauges[w].gain);
    EXPECT_EQ(a.gauges[w].force, b.gauges[w].force);
    EXPECT_EQ(a.gauges[w].moment, b.gauges[w].moment);
  }
  for (std::size_t c = 0; c < a.cameras.size(); ++c) {
    EXPECT_EQ(a.cameras[c].X_WC.position, b.cameras[c].X_WC.position);
    EXPECT_TRUE(a.cameras[c].X_WC.rotation.isApprox(b.cameras[c].X_WC.rotation));
    EXPECT_EQ(a.cameras[c].focal, b.cameras[c].focal);
    EXPECT_EQ(a.cameras[c].distortion, b.cameras[c].distortion);
  }
}

TEST_P(SceneDefinitions, SayAllThatOthersAskFor) {
  const SceneEffectDefinition& d = definition();
  EXPECT_FALSE(d.plain_name.empty());
  EXPECT_FALSE(d.sentence.empty());
  EXPECT_FALSE(d.tells_apart.empty());
  EXPECT_NE(d.home, SceneHome::unset);
  EXPECT_TRUE(d.apply);
  std::set<std::string> names;
  for (const EffectParameter& one : d.parameters) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_FALSE(one.sentence.empty()) << one.name;
    if (one.size == 0) continue;
    EXPECT_FALSE(one.unit.empty()) << one.name;
    EXPECT_EQ(one.first.size(), std::size_t(one.size)) << one.name;
  }
  EXPECT_TRUE(std::ranges::any_of(d.parameters, [](const EffectParameter& one) {
    return one.vanishes != Vanishes::never;
  })) << "nothing that a fit could shrink";
  // What cameras and force sensors report is no motion.
  EXPECT_TRUE(d.is_only_seen || (d.home != SceneHome::camera && d.home != SceneHome::wrench));
  std::set<std::string> symptoms;
  for (const effects::Sign& sign : d.speaks_for) {
    EXPECT_TRUE(symptoms.insert(sign.symptom).second) << sign.symptom;
    EXPECT_GE(sign.rank, 1) << sign.symptom;
  }
}

TEST_P(SceneDefinitions, OfNoSizeDoNothing) {
  const ArmAtStem at;
  const Experiment read = experiment(at);
  const SceneState nominal = nominal_state(read);
  SceneState state = nominal;
  plant::Effect effect = without_size(definition(), nominal);
  if (vanishes_at_infinity(definition())) {
    // A spring that vanishes when it is stiff: a stiffer one is nearer to none.
    for (auto& [name, value] : effect.numbers) value = {1.0e12};
    EXPECT_TRUE(apply_scene_effect(effect, read, state));
    EXPECT_TRUE(state.joint_stiffness >= 1.0e12 || state.coupling.contact_stiffness >= 1.0e12);
    return;
  }
  EXPECT_TRUE(apply_scene_effect(effect, read, state));
  expect_same(state, nominal);
}

TEST_P(SceneDefinitions, StartWithNumbersThatTheyHave) {
  const ArmAtStem at;
  const Experiment read = experiment(at);
  ASSERT_TRUE(definition().starts);
  const std::vector<SceneFit> starts = starts_of(definition(), {read});
  ASSERT_FALSE(starts.empty());
  for (const SceneFit& start : starts) {
    EXPECT_EQ(start.effect.name, definition().name);
    ASSERT_FALSE(start.free.empty());
    bool sized = false;
    for (const effects::FreeParameter& free : start.free) {
      EXPECT_LT(free.low, free.high) << free.name;
      const EffectParameter* described = definition().find(free.name);
      ASSERT_TRUE(described) << free.name;
      EXPECT_EQ(free.unit, described->unit) << free.name;
      sized = sized || free.vanishes != Vanishes::never;
    }
    EXPECT_TRUE(sized) << "nothing that a fit could shrink";
    SceneState state = nominal_state(read);
    EXPECT_TRUE(apply_scene_effect(start.effect, read, state));
  }
}

// Only what was not seen is part of the baseline, and each of its numbers has a prior.
TEST_P(SceneDefinitions, AreInTheBaselineWhereNothingShowsThem) {
  if (!definition().in_baseline) return;
  const InBaseline& own = *definition().in_baseline;
  EXPECT_TRUE(definition().find(own.parameter)) << own.parameter;
  EXPECT_FALSE(own.because.empty());
  const ArmAtStem plain;
  Experiment seen = experiment(plain);
  seen.trials.front().markers.value.setZero();
  EXPECT_TRUE(own.fits({seen}).empty());
  ArmAtStem at;
  at.instruments = "wrenches:\n  - {name: wrist, link: finger}\n";
  at.sees_nothing = true;
  const Experiment blind = experiment(at);
  const std::vector<SceneFit> fits = baseline_effects({blind});
  ASSERT_EQ(fits.size(), blind.plants.size());
  for (const effects::FreeParameter& free : fits.front().free) {
    EXPECT_GT(free.prior, 0.0) << free.name;
    const bool told = free.name == own.parameter;
    EXPECT_EQ(told_of_baseline(fits.front().effect, free), told ? &definition() : nullptr);
  }
  const InBaseline::Told told = own.told(blind, fits.front().effect, 0);
  EXPECT_EQ(told.name, "bush_root_x");
  EXPECT_DOUBLE_EQ(told.nominal, ArmAtStem::reach);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const SceneEffectDefinition& one : scene_effect_definitions()) names.push_back(one.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, SceneDefinitions, testing::ValuesIn(all_names()),
                         [](const auto& named) { return named.param; });

TEST(SceneEffectList, HasEachNameOnceAndNoneOfAPlants) {
  std::set<std::string> names;
  for (const std::string& name : all_names()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_FALSE(effects::find_effect(name)) << name;
  }
  EXPECT_GE(names.size(), 17u);
}

TEST(SceneEffectList, RanksWhatASymptomSpeaksFor) {
  using testing::ElementsAre;
  EXPECT_THAT(scene_spoken_for("touch_onset"),
              ElementsAre("plant_pose", "tool_pose", "robot_latency", "joint_offset"));
  EXPECT_EQ(scene_spoken_for("touch_onset"), scene_spoken_for("touch_end"));
  EXPECT_THAT(scene_spoken_for("friction_ratio"), ElementsAre("contact_friction", "wrench_gain"));
  EXPECT_THAT(scene_spoken_for("slip"), ElementsAre("contact_friction"));
  EXPECT_THAT(scene_spoken_for("wrench_at_rest"),
              ElementsAre("wrench_bias", "payload", "wrench_gain"));
  EXPECT_THAT(scene_spoken_for("moment_at_rest"), ElementsAre("wrench_bias", "payload"));
  EXPECT_THAT(scene_spoken_for("image_motion"),
              ElementsAre("camera_pose", "camera_focal", "lens_distortion"));
  EXPECT_THAT(scene_spoken_for("force_breaks_off"),
              ElementsAre("detachment_threshold", "contact_friction"));
  // Effects of plants make some of them, too.
  EXPECT_THAT(scene_spoken_for("robot_lag"), ElementsAre("robot_latency", "latency"));
  EXPECT_THAT(scene_spoken_for("plant_shift"), ElementsAre("plant_pose", "frame_rotation"));
  EXPECT_THAT(scene_spoken_for("detachment"),
              ElementsAre("detachment_threshold", "detachment_law"));
  EXPECT_TRUE(scene_spoken_for("no such symptom").empty());
}

}  // namespace
}  // namespace pedicel::discrepancy
