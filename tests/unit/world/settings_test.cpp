#include "engine/world/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/check.h"

namespace pedicel::world {
namespace {

using ::testing::HasSubstr;

struct Knobs {
  double friction = 0.5;
  int sweeps = 3;
  bool both = false;
  int kind = 0;
  std::vector<Parameter> parameters() {
    return {{"friction", "1", &friction, 0.0, 2.0, "How it grips."},
            {"sweeps", "1", &sweeps, 1.0, 9.0, "How often."},
            {"both", "1", &both, 0.0, 1.0, "Both ways."}};
  }
  std::vector<WordSetting> words() { return {{"kind", {"plain", "fancy"}, &kind}}; }
  std::string apply(const std::string& key, const std::string& text) {
    Diagnostics diagnostics;
    apply_settings({{key, text, {"a.yaml", 3, 5}}}, "rods", parameters(), words(), diagnostics);
    return diagnostics.text();
  }
};

TEST(Settings, SetNumbersFlagsAndWords) {
  Knobs knobs;
  EXPECT_EQ(knobs.apply("friction", "0.8") + knobs.apply("sweeps", "7") +
                knobs.apply("both", "true") + knobs.apply("kind", "fancy"),
            "");
  EXPECT_EQ(knobs.friction, 0.8);
  EXPECT_EQ(knobs.sweeps, 7);
  EXPECT_TRUE(knobs.both);
  EXPECT_EQ(knobs.kind, 1);
}

TEST(Settings, RefusalsNamePlaceKeyAndWhatWasExpected) {
  Knobs knobs;
  EXPECT_THAT(knobs.apply("frction", "1"),
              HasSubstr("a.yaml:3:5: error: unknown key \"frction\" in rods, expected one of: "
                        "friction, sweeps, both, kind"));
  EXPECT_THAT(knobs.apply("friction", "3"),
              HasSubstr("rods.friction = 3: must be between 0 and 2"));
  EXPECT_THAT(knobs.apply("friction", "much"),
              HasSubstr("rods.friction is \"much\", expected a number (1)"));
  EXPECT_THAT(knobs.apply("kind", "odd"),
              HasSubstr("rods.kind is \"odd\", expected one of: plain, fancy"));
  EXPECT_EQ(knobs.friction, 0.5);
  EXPECT_EQ(knobs.kind, 0);
}

TEST(Override, ReachesTheScenesOwnNumbers) {
  Scene scene;
  apply_override(scene, "dt", "0.001");
  apply_override(scene, "duration", "2.5");
  apply_override(scene, "seed", "7");
  apply_override(scene, "threads", "2");
  EXPECT_EQ(scene.dt, 0.001);
  EXPECT_EQ(scene.duration, 2.5);
  EXPECT_EQ(scene.seed, 7);
  EXPECT_EQ(scene.threads, 2);
}

TEST(Override, GoesToOnePlantOrToAll) {
  Scene scene;
  scene.plants.resize(2);
  scene.plants[0].name = "truss";
  scene.plants[1].name = "stem";
  apply_override(scene, "plants.stem.detach.stretch", "0.2");
  apply_override(scene, "material.density", "600");
  ASSERT_EQ(scene.plants[0].set.size(), 1u);
  ASSERT_EQ(scene.plants[1].set.size(), 2u);
  EXPECT_EQ(scene.plants[1].set[0].key, "detach.stretch");
  EXPECT_EQ(scene.plants[1].set[0].text, "0.2");
  EXPECT_EQ(scene.plants[0].set[0].key, "material.density");
}

TEST(Override, GoesToSections) {
  Scene scene;
  apply_override(scene, "rods.newton_iterations", "6");
  apply_override(scene, "coupling.friction", "0.9");
  EXPECT_EQ(scene.rods.at(0).key, "newton_iterations");
  EXPECT_EQ(scene.coupling.at(0).text, "0.9");
}

TEST(Override, GoesToTheGripper) {
  Scene scene;
  EXPECT_THROW(apply_override(scene, "robot.gripper_force", "5"), UsageError);
  scene.robot.emplace().gripper = "finger_joint";
  apply_override(scene, "robot.gripper_force", "5");
  EXPECT_EQ(scene.robot->gripper_force, 5.0);
  EXPECT_THROW(apply_override(scene, "robot.gripper_force", "-5"), UsageError);
  EXPECT_THROW(apply_override(scene, "robot.gripper_force", "1e7"), UsageError);
  EXPECT_THROW(apply_override(scene, "robot.gripper", "5"), UsageError);
}

std::string refusal(const std::string& key, const std::string& value) {
  Scene scene;
  try {
    apply_override(scene, key, value, "--set ");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "taken";
}

TEST(Override, RefusalsSayWhatWasExpected) {
  EXPECT_THAT(refusal("dt", "-1"), HasSubstr("dt = \"-1\": must be a number between 1e-07 and 1"));
  EXPECT_THAT(refusal("seed", "1.5"), HasSubstr("must be a whole number between 0 and"));
  EXPECT_THAT(refusal("tempo", "1"), HasSubstr("--set tempo: expected duration, dt"));
  EXPECT_THAT(refusal("plants.oak.detach.bend", "1"),
              HasSubstr("--set plants.oak.detach.bend: the scene has no plant of that name"));
  EXPECT_THROW(split_assignment("dt"), UsageError);
  EXPECT_THROW(split_assignment("=3"), UsageError);
  EXPECT_EQ(split_assignment("a.b=c=d").second, "c=d");
}

}  // namespace
}  // namespace pedicel::world
