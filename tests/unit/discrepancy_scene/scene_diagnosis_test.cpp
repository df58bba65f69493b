#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

#include <gmock/gmock.h>

#include "engine/world/scene_reader.h"
#include "plugins/discrepancy/scene/run_effects.h"
#include "plugins/discrepancy/scene_procedure/extended_scene.h"
#include "tests/unit/discrepancy_scene/diagnosed_scene.h"

namespace pedicel::discrepancy {
namespace {

using testing::Contains;
using testing::Field;

TEST_F(DiagnosedScene, NothingHiddenIsAdequate) {
  const SceneDiagnosis found = diagnose({});
  EXPECT_EQ(found.verdict.outcome, Outcome::adequate) << found.text;
  EXPECT_TRUE(found.verdict.causes.empty()) << found.text;
  EXPECT_LT(*found.verdict.fit.nominal, 1.1);
}

TEST_F(DiagnosedScene, AStopEndsTheSearchAndWhatIsKnownIsTold) {
  stops_ = true;
  const SceneDiagnosis found = diagnose({"{name: wrench_bias, force: [0.3, 0, -0.2]}"});
  EXPECT_EQ(cut_, 1);
  EXPECT_TRUE(found.verdict.partial);
  ASSERT_TRUE(found.verdict.fit.nominal);
  EXPECT_GT(*found.verdict.fit.nominal, 1.5);
  EXPECT_FALSE(found.text.empty());
}

TEST_F(DiagnosedScene, ASensorsBiasIsNamedWithItsSize) {
  const SceneDiagnosis found =
      diagnose({"{name: wrench_bias, force: [0.3, 0, -0.2], moment: [0, 0.02, 0]}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  const NamedCause* bias = cause(found, "wrench_bias");
  ASSERT_TRUE(bias) << found.text;
  EXPECT_NEAR(bias->parameters.at("force")[0].value, 0.3, 0.02);
  EXPECT_NEAR(bias->parameters.at("force")[2].value, -0.2, 0.02);
  EXPECT_GT(*bias->share.fit, 0.9);
  EXPECT_GT(*bias->change.force, 0.3);
  // A symptom says the same without any fit.
  EXPECT_THAT(found.verdict.symptoms,
              Contains(testing::AllOf(Field(&SymptomNumber::name, "wrench_at_rest"),
                                      Field(&SymptomNumber::shows, true))));
  const LeftMisfit& left = found.verdict.left;
  EXPECT_LT(*left.share.fit, 0.1);
  EXPECT_THAT(left.channels, Contains(Field(&LeftMisfit::Channel::name, "moment")));
  EXPECT_THAT(left.symptoms, testing::Not(Contains("wrench_at_rest")));
}

TEST_F(DiagnosedScene, AMovedPlantIsNamedAndItsSceneRuns) {
  const SceneDiagnosis found = diagnose({"{name: plant_pose, offset: [0.003, -0.004, 0]}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  const NamedCause* pose = cause(found, "plant_pose");
  ASSERT_TRUE(pose) << found.text;
  EXPECT_NEAR(pose->parameters.at("offset")[1].value, -0.004, 3.0e-4);
  const TemporaryFolder out;
  const ExtendedScene extended = write_extended_scene(out / "", made_, found.model, 0);
  ASSERT_EQ(extended.file, "extended.scene.yaml");
  Diagnostics diagnostics;
  const auto scene = world::read_scene(out / extended.file, diagnostics);
  ASSERT_TRUE(scene) << diagnostics.text();
  // The plant stands where the nominal scene has it, and an effect moves it.
  EXPECT_NEAR(scene->plants.front().pose.position.y(), 0.03, 1.0e-12);
  const RunEffects effects = read_run_effects(*scene, &made_.robot, {}, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << diagnostics.text();
  EXPECT_NEAR(effects.state.plants.front().offset.y(), -0.004, 5.0e-4);
}

// Nothing of the plant is seen: where it stands is found from what it does to the arm.
TEST_F(DiagnosedScene, FromTheRobotAloneAPlantIsFoundWhereItIsPushed) {
  at_.instruments =
      "wrenches:\n  - {name: wrist, link: finger}\n"
      "noise: {force_std: 0.03, moment_std: 0.002, joint_std: 0.00002}\n";
  at_.trials = "trials:\n  - {name: push, folder: push, robot: {follows: joints}}\n";
  at_.sees_nothing = true;
  const SceneDiagnosis found = diagnose(
      {"{name: plant_pose, offset: [0, 0.008, 0]}", "{name: youngs_modulus, factor: 1.3}"});
  const NamedCause* place = cause(found, "plant_pose");
  ASSERT_TRUE(place) << found.text;
  const Estimate& y = place->parameters.at("offset")[1];
  EXPECT_NEAR(y.value, 0.008, 1.0e-3) << found.text;
  // How high it stands and how stiff it is, one push at one height tells apart but roughly.
  EXPECT_LT(*found.verdict.fit.refitted, 0.1 * *found.verdict.fit.nominal) << found.text;
  EXPECT_NEAR(found.verdict.parameters.at("bush_root_y").value, 0.038, 1.0e-3);
  // 0.6 m tall, and pushed at 0.3 m by a flat finger: along the stem the push may be anywhere on
  // it.
  const auto hold = std::ranges::find(found.verdict.symptoms, "hold_place", &SymptomNumber::name);
  ASSERT_NE(hold, found.verdict.symptoms.end()) << found.text;
  EXPECT_EQ(hold->unit, "m");
}

TEST_F(DiagnosedScene, AForceFromOutsideIsUnknownWithPlaceTimeAndDirection) {
  at_.gap = "0.2";  // the finger stays away
  SceneForce force;
  force.place = {"stem", 0.75, {}};
  force.force = {-0.06, 0.0, 0.0};
  force.from = 0.5;
  force.rise = 0.1;
  const SceneDiagnosis found = diagnose({}, {force});
  EXPECT_EQ(found.verdict.outcome, Outcome::unknown) << found.text;
  ASSERT_TRUE(found.verdict.unknown) << found.text;
  const OutsideAction& outside = *found.verdict.unknown;
  EXPECT_EQ(outside.place.curve, "stem");
  EXPECT_NEAR(outside.place.at, 0.75, 0.1);
  EXPECT_NEAR(outside.from, 0.5, 0.15);
  EXPECT_LT(outside.direction.x(), -0.8);
  EXPECT_NEAR(outside.position.z(), 0.45, 0.06);
}

}  // namespace
}  // namespace pedicel::discrepancy
