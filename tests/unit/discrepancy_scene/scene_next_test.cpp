#include "plugins/discrepancy/scene_next/scene_next.h"

#include <gmock/gmock.h>

#include "engine/core/check.h"
#include "plugins/discrepancy/data/more_trials.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/report/scene_next_report.h"
#include "plugins/discrepancy/scene_next/arm_way.h"
#include "plugins/discrepancy/scene_next/motion_designs.h"
#include "tests/unit/discrepancy_scene/diagnosed_scene.h"

namespace pedicel::discrepancy {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::StartsWith;

/// The finger at the stem with a wrist, which turns the finger about the arm's y.
std::string with_wrist(const std::string& speed = "5") {
  return R"(<?xml version="1.0"?>
<robot name="swing">
  <link name="base"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <link name="arm"><inertial><origin xyz="0.2 0 0"/><mass value="0.3"/><inertia ixx="0.0001" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.3"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="50" velocity=")" +
         speed + R"("/><dynamics damping="0.5" friction="0.1"/></joint>
  <link name="finger"><inertial><origin xyz="0 0 0.02"/><mass value="0.05"/><inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0002" iyz="0" izz="0.000002"/></inertial>
    <collision><geometry><box size="0.08 0.012 0.2"/></geometry></collision></link>
  <joint name="wrist" type="revolute"><parent link="arm"/><child link="finger"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="50" velocity="5"/></joint>
</robot>
)";
}

std::vector<std::string> actions(const std::vector<MotionDesign>& designs) {
  std::vector<std::string> all;
  for (const MotionDesign& one : designs) all.push_back(one.action);
  return all;
}

class MotionDesigns : public testing::Test {
 protected:
  Experiment experiment(const std::string& urdf) {
    at_.write_all();
    at_.write("arm.urdf", urdf);
    return at_.read();
  }
  ArmAtStem at_;
};

TEST_F(MotionDesigns, AreMadeFromATrialAndMeasureNothing) {
  const Experiment plain = experiment(with_wrist());
  const std::vector<MotionDesign> designs = motion_designs(plain, 0);
  EXPECT_GE(designs.size(), 9u);
  for (const char* part :
       {"half the speed", "twice the speed", "half as far", "other side", "goes farthest",
        "begin with wrist turned", "then turn wrist", "touch nothing"})
    EXPECT_THAT(actions(designs), Contains(HasSubstr(part)));
  for (const MotionDesign& one : designs) {
    const Trial& trial = one.trial;
    EXPECT_EQ(trial.joint_columns, (std::vector{0, 1})) << one.action;
    EXPECT_TRUE(trial.joints.value.allFinite()) << one.action;
    ASSERT_EQ(trial.wrenches.size(), 1u);
    EXPECT_TRUE(trial.wrenches[0].value.array().isNaN().all()) << one.action;
    EXPECT_NEAR(trial.wrenches[0].time.back(), trial.joints.time.back(), 0.011) << one.action;
  }
}

TEST_F(MotionDesigns, KeepLimitsAndSpeeds) {
  // The swing's own speed is 0.28 rad/s.
  const Experiment slow = experiment(with_wrist("0.4"));
  const std::vector<MotionDesign> designs = motion_designs(slow, 0);
  EXPECT_THAT(actions(designs), Each(testing::Not(HasSubstr("twice the speed"))));
  EXPECT_THAT(actions(designs), Contains(HasSubstr("half the speed")));
  for (const MotionDesign& one : designs)
    for (int r = 0; r < one.trial.joints.size(); ++r) {
      const auto row = one.trial.joints.value.row(r);
      EXPECT_GE(row[1], -1.0) << one.action;
      EXPECT_LE(row[1], 2.0) << one.action;
      if (r > 0) {
        const double step = one.trial.joints.time[static_cast<std::size_t>(r)] -
                            one.trial.joints.time[static_cast<std::size_t>(r) - 1];
        EXPECT_LE(std::abs(row[0] - one.trial.joints.value(r - 1, 0)) / step, 0.4 + 1.0e-6)
            << one.action;
      }
    }
}

TEST_F(MotionDesigns, KeepOffTheGround) {
  // A finger 0.8 m long and turned by 90 degrees would be fine; upright its half goes below.
  at_.scene_more = "ground: {height: 0.15}\n";
  const Experiment plain = experiment(with_wrist());
  const Trial& trial = plain.trials.front();
  const ArmWay way = measured_way(plain, trial);
  const WayCheck check(plain, trial, way);
  EXPECT_TRUE(check.allows(way));
  ArmWay low = way;
  low.q.assign(3, Eigen::Vector2d(0.0, 0.0));
  EXPECT_TRUE(check.allows(low)) << "0.2 m above zero, 0.05 above the ground";
  // The box is 0.08 m wide: turned by 0.4 rad its corner is lower than upright.
  Experiment higher = plain;
  higher.scene.ground->height = 0.199;
  const WayCheck tight(higher, trial, way);
  EXPECT_TRUE(tight.allows(way)) << "where it was measured";
  low.q.assign(3, Eigen::Vector2d(0.0, 0.2));
  EXPECT_FALSE(tight.allows(low));
  EXPECT_TRUE(check.allows(low));
}

TEST_F(MotionDesigns, StayOffThePlantWhereTheyTouchNothing) {
  const Experiment plain = experiment(with_wrist());
  const Trial& trial = plain.trials.front();
  const WayCheck check(plain, trial, measured_way(plain, trial));
  // Half of the finger's 12 mm and the stem's radius from its 30 mm.
  EXPECT_NEAR(check.clearance(Eigen::Vector2d(0.0, 0.0)), 0.030 - 0.006 - 0.004, 1.0e-4);
  for (const MotionDesign& one : motion_designs(plain, 0)) {
    if (!one.action.starts_with("touch nothing")) continue;
    for (int r = 0; r < one.trial.joints.size(); ++r)
      EXPECT_GT(check.clearance(one.trial.joints.value.row(r).transpose()), 4.0e-3);
  }
}

class SceneNextMotion : public DiagnosedScene {
 protected:
  SceneNextMotion() { more_["arm.urdf"] = with_wrist(); }

  SceneDiagnosis again(const Experiment& experiment) {
    SceneDiagnosisOptions options;
    options.numerics = numerics_;
    options.settings.search.mesh = numerics_.distance;
    options.settings.search.dt = numerics_.dt;
    return diagnose_scene(experiment, options);
  }
  /// The motion that was asked for, done with something hidden, as files.
  Experiment answer(const std::filesystem::path& plan, const SceneNext& next,
                    const std::string& hidden) {
    Diagnostics diagnostics;
    const auto like = read_experiment(plan, diagnostics);
    if (!like) throw InvalidFile(diagnostics);
    SceneVariant variant;
    variant.effects = {scene_effect(hidden, *like)};
    SceneObserveOptions how;
    how.numerics = numerics_;
    how.seed = 7;
    Experiment told = *like;
    told.noise = next.noise;
    Experiment made = observed_scene(told, variant, how);
    made.folder = plan;
    return made;
  }
};

// A weight at a tool that is always upright is a zero of its sensor.
TEST_F(SceneNextMotion, ALoadAndASensorsZeroAreToldApartByAWrist) {
  const std::string load = "{name: payload, mass: 0.03, centre: [0, 0, 0.02]}";
  SceneDiagnosis found = diagnose({load});
  EXPECT_EQ(found.verdict.outcome, Outcome::ambiguous) << found.text;
  ASSERT_TRUE(found.next.experiment) << found.next.sentence << "\n" << found.text;
  EXPECT_THAT(found.next.names, Contains("payload"));
  EXPECT_THAT(found.next.names, Contains("wrench_bias"));
  EXPECT_THAT(found.next.sentence, HasSubstr("wrist"));
  EXPECT_EQ(found.verdict.next_experiment, found.next.sentence);
  EXPECT_GT(found.next.tried.size(), 5u);
  const TemporaryFolder out;
  EXPECT_EQ(write_scene_next(out / "", found.next), "next/experiment.yaml");
  for (const std::string& name : found.next.names)
    for (const char* file : {"wrench_wrist.csv", "markers.csv", "pixels_left.csv", "torques.csv"})
      EXPECT_TRUE(std::filesystem::exists(out / ("next/next_1/predicted_" + name + "/" + file)))
          << name << " " << file;
  EXPECT_TRUE(std::filesystem::exists(out / "next/next_1/predictions.svg"));
  const Experiment made = answer(out / "next", found.next, load);
  EXPECT_TRUE(made.trials[0].wrenches[0].value.allFinite());
  Experiment both = made_;
  add_trials(made, both);
  ASSERT_EQ(both.trials.size(), 2u);
  const SceneDiagnosis last = again(both);
  EXPECT_EQ(last.verdict.outcome, Outcome::named) << last.text;
  ASSERT_EQ(last.verdict.causes.size(), 1u) << last.text;
  EXPECT_EQ(last.verdict.causes[0].name, "payload") << last.text;
  EXPECT_NEAR(last.verdict.causes[0].parameters.at("mass")[0].value, 0.03, 0.003);
}

TEST_F(SceneNextMotion, WhatIsClearAsksForNothing) {
  const SceneDiagnosis found = diagnose({"{name: plant_pose, offset: [0.003, -0.004, 0]}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  EXPECT_FALSE(found.next.experiment) << found.next.sentence;
  EXPECT_TRUE(found.verdict.next_experiment.empty()) << found.verdict.next_experiment;
}

TEST_F(MotionDesigns, LaterTrialsMustBeOfTheSamePlace) {
  const Experiment first = experiment(with_wrist());
  const auto refusal = [&](const Experiment& more) -> std::string {
    Experiment both = first;
    try {
      add_trials(more, both);
    } catch (const UsageError& fault) {
      return fault.what();
    }
    return "";
  };
  EXPECT_THAT(refusal(first), HasSubstr("trial \"push\" is there already"));
  Experiment more = first;
  more.trials[0].name = "again";
  EXPECT_EQ(refusal(more), "");
  std::swap(more.markers[0], more.markers[1]);
  EXPECT_EQ(refusal(more), "");
  Experiment both = first;
  more.trials[0].markers.value.leftCols(3).setConstant(1.0);
  add_trials(more, both);
  EXPECT_EQ(both.trials[1].markers.value(0, 3), 1.0) << "of the second marker before";
  EXPECT_TRUE(std::isnan(both.trials[1].markers.value(0, 0)));
  more.markers[0].place.at = 0.3;
  EXPECT_THAT(refusal(more), HasSubstr("sits elsewhere than before"));
  more = first;
  more.trials[0].name = "again";
  more.plants[0].file.curves[0].points[1].x() += 0.01;
  EXPECT_THAT(refusal(more), HasSubstr("plant \"bush\" is not what it was"));
  more = first;
  more.trials[0].name = "again";
  more.wrenches[0].name = "other";
  EXPECT_THAT(refusal(more), HasSubstr("wrench \"other\" is not among"));
}

}  // namespace
}  // namespace pedicel::discrepancy
