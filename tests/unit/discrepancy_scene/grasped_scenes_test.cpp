// Arms that follow commands, and fruits that are grasped and come off.
#include <gtest/gtest.h>

#include "plugins/discrepancy/scene_procedure/robot_alone.h"
#include "tests/unit/discrepancy_scene/diagnosed_scene.h"

namespace pedicel::discrepancy {
namespace {

/// The finger takes the fruit at the stem's tip at once and pulls it aside.
class GraspedFruit : public DiagnosedScene {
 protected:
  GraspedFruit() {
    at_.gap = "0.2";  // it touches nothing
    more_["plant.yaml"] =
        "format: pedicel-plant\nversion: 1\nname: bush\nmaterial: {youngs_modulus: 1.0e+10, "
        "poisson_ratio: 0.35, density: 700, damping_time: 0.002}\nsampling: {connect: 0.004, "
        "distance: 0.05}\nroot: [0, 0, 0]\ncurves:\n  - {name: stem, interpolation: linear, "
        "points: [[0, 0, 0], [0, 0, 0.6]], radius: 0.004}\nfruits:\n  - {name: apple, curve: "
        "stem, at: 1, radius: 0.012, density: 950, detach: {force: 0.8}}\n";
    more_["push/events.csv"] = "time,event,what,by\n0.05,grasped,apple,finger\n";
  }
  double came_off() const {
    for (const MeasuredEvent& event : made_.trials.front().events)
      if (event.event == "detached") return event.time;
    return std::nan("");
  }
};

TEST_F(GraspedFruit, ComesOffWhereTheWrenchAloneSaysSo) {
  at_.instruments =
      "wrenches:\n  - {name: wrist, link: finger}\n"
      "noise: {force_std: 0.03, moment_std: 0.002, joint_std: 0.00002}\n";
  at_.sees_nothing = true;
  const SceneDiagnosis found = diagnose({});
  ASSERT_TRUE(std::isfinite(came_off()));
  const auto broke =
      std::ranges::find(found.verdict.symptoms, "force_breaks_off", &SymptomNumber::name);
  ASSERT_NE(broke, found.verdict.symptoms.end()) << found.text;
  EXPECT_NEAR(broke->value, came_off(), 0.03);
}

// A slow sensor sees it grow in steps as large as jumps.
TEST(RobotAlone, APushThatGrowsIsNoBreak) {
  const ArmAtStem at;
  at.write_all();
  Experiment made = observed_scene(at.read(), {}, {});
  const SceneDataSet data(made);
  const Samples all = made.trials.front().wrenches.front();
  for (const long every : {1, 8}) {
    Samples& kept = made.trials.front().wrenches.front();
    kept = {};
    for (long i = 0; i < all.size(); i += every) {
      kept.time.push_back(all.time[static_cast<std::size_t>(i)]);
      kept.value.conservativeResize(kept.size(), all.value.cols());
      kept.value.row(kept.size() - 1) = all.value.row(i);
    }
    SceneSimulator simulator(made, {}, 1);
    for (const SymptomNumber& one : robot_alone(simulator, {}, data.deviation(SceneChannel::force),
                                                data.deviation(SceneChannel::moment), Vec3::Zero(),
                                                default_scene_settings().robot))
      EXPECT_NE(one.name, "force_breaks_off") << every << ": " << one.sentence;
  }
}

TEST_F(GraspedFruit, AThresholdIsNamedWithItsFactor) {
  const SceneDiagnosis found = diagnose({"{name: detachment_threshold, factor: 0.7}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  const NamedCause* threshold = cause(found, "detachment_threshold");
  ASSERT_TRUE(threshold) << found.text;
  // The moment is known to a sample of 10 ms, which is some 5 % of the pull.
  EXPECT_NEAR(threshold->parameters.at("factor")[0].value, 0.7, 0.1) << found.text;
}

TEST_F(GraspedFruit, HangsOnTheLinkOnceItIsOff) {
  at_.write_all();
  for (const auto& [name, text] : more_) at_.write(name, text);
  const SceneReadings told = readings_of(at_.read(), {"{name: detachment_threshold, factor: 0.2}"});
  ASSERT_EQ(told.events.size(), 1U);
  // At rest in the end: the finger's own 0.05 kg, and the fruit's.
  const double fruit = 4.0 / 3.0 * 3.14159265 * std::pow(0.012, 3) * 950.0;
  const long last = told.wrenches[0].rows() - 1;
  EXPECT_NEAR(told.wrenches[0](last, 2), -(0.05 + fruit) * 9.81, 5.0e-3);
}

/// The arm's controller gets commands, and its encoders are measured.
class CommandedArm : public DiagnosedScene {
 protected:
  CommandedArm() {
    at_.trials = "trials:\n  - {name: push, folder: push, robot: {follows: commands}}\n";
    std::string commands = "time,turn\n";
    for (int i = 0; i <= 120; ++i)
      commands += std::to_string(0.01 * i) + "," + std::to_string(at_.joint(0.01 * i)) + "\n";
    more_["push/commands.csv"] = commands;
  }
};

TEST_F(CommandedArm, WithNothingHiddenIsAdequate) {
  const SceneDiagnosis found = diagnose({});
  EXPECT_EQ(found.verdict.outcome, Outcome::adequate) << found.text;
}

TEST_F(CommandedArm, ThatLagsIsNamed) {
  const SceneDiagnosis found = diagnose({"{name: tracking_lag, time: 0.05}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  const NamedCause* lag = cause(found, "tracking_lag");
  ASSERT_TRUE(lag) << found.text;
  EXPECT_NEAR(lag->parameters.at("time")[0].value, 0.05, 0.005) << found.text;
}

// Rows of instruments lie between the steps of the arm.
TEST_F(CommandedArm, ItsTorquesAreThoseOfItsMotionBetweenStepsToo) {
  at_.gap = "0.5";  // it touches nothing
  at_.write_all();
  for (const auto& [name, text] : more_) at_.write(name, text);
  const SceneReadings told = readings_of(at_.read(), {}, {0.02, 7.0e-4, 0.05, 1.0e-5});
  // kg m2, of the arm and the finger about the joint; N m s and N m, of its URDF.
  const double inertia = 0.004 + 0.3 * 0.2 * 0.2 + 2.0e-6 + 0.05 * 0.4 * 0.4;
  const double damping = 0.5, friction = 0.1, e = 1.0e-3;
  for (int row = 20; row <= 80; ++row) {
    const double t = 0.01 * row, before = at_.joint(t - e), after = at_.joint(t + e);
    const double speed = (after - before) / (2.0 * e);
    const double acceleration = (after - 2.0 * at_.joint(t) + before) / (e * e);
    EXPECT_NEAR(told.torques(row, 0), inertia * acceleration + damping * speed + friction, 0.01)
        << t << " s";
  }
}

}  // namespace
}  // namespace pedicel::discrepancy
