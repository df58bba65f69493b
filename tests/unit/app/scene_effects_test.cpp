#include <gtest/gtest.h>

#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"
#include "plugins/simulation/instrument.h"
#include "plugins/simulation/scene_assets.h"
#include "plugins/simulation/simulation.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::app {
namespace {

using discrepancy::ArmAtStem;
using discrepancy::Experiment;

// What a run of the scene must do: with the same effects the diagnosis' own model says the same of
// its instruments.
class RunOfScene : public testing::Test {
 protected:
  struct Said {
    Vec3 tip, nail;
    Eigen::Matrix<double, 6, 1> wrench;
    double reading = 0.0;  // rad
  };

  world::Scene scene(const std::string& effects) {
    at_.scene_more = "wrenches: [{name: wrist, link: finger, rate: 1000}]\n";
    if (!effects.empty()) at_.scene_more += "effects:\n  - " + effects + "\n";
    at_.write_all();
    std::string log = "time_s,turn\n";
    for (int i = 0; i <= 1200; ++i) {
      char row[60];
      std::snprintf(row, sizeof row, "%.3f,%.9f\n", 1.0e-3 * i, at_.joint(1.0e-3 * i));
      log += row;
    }
    at_.write("log.csv", log);
    Diagnostics diagnostics;
    auto read = world::read_scene(at_.path() / "scene.yaml", diagnostics);
    if (!read) throw InvalidFile(diagnostics);
    read->robot->trajectory = at_.path() / "log.csv";
    return *read;
  }

  Said run(const std::string& effects, double until) {
    simulation::Simulation simulation(scene(effects), {});
    while (simulation.world().time() < until - 1.0e-9) {
      const world::WorldReport& report = simulation.step();
      EXPECT_EQ(report.errors, 0) << report.culprit << ": " << report.cause;
    }
    const cosserat::RodModel& model = simulation.rods().model(0);
    const int last = model.size() - 1;
    Said said;
    said.tip = cosserat::point_on(model, simulation.rods().state(0), last, 0.0);
    const simulation::RobotControl& robot = *simulation.robot();
    said.nail = robot.link_pose(robot.description().link("finger")) * Vec3(0, 0, 0.1);
    said.wrench = simulation.instruments().front()->reading();
    said.reading = robot.reading(0);
    return said;
  }

  Said predicted(const std::string& effects, double until) {
    at_.scene_more.clear();
    at_.write_all();
    const Experiment experiment = at_.read();
    const discrepancy::SceneReadings all = discrepancy::readings_of(
        experiment, effects.empty() ? std::vector<std::string>{} : std::vector{effects},
        {0.05, 1.0e-3, 0.0, 2.0e-4});
    const auto row = static_cast<long>(std::lround(until / 0.01));
    Said said;
    said.tip = all.markers.row(row).segment<3>(0).transpose();
    said.nail = all.markers.row(row).segment<3>(6).transpose();
    said.wrench = all.wrenches.front().row(row).transpose();
    return said;
  }

  void expect_alike(const std::string& effects, double until = 1.1) {
    SCOPED_TRACE(effects);
    const Said run_says = run(effects, until), model_says = predicted(effects, until);
    EXPECT_LT((run_says.tip - model_says.tip).norm(), 6.0e-4);
    EXPECT_LT((run_says.nail - model_says.nail).norm(), 3.0e-4);
    EXPECT_LT((run_says.wrench - model_says.wrench).norm(), 0.07)
        << run_says.wrench.transpose() << " for " << model_says.wrench.transpose();
  }

  ArmAtStem at_;
};

TEST_F(RunOfScene, WithoutEffectsItSaysWhatTheDiagnosisPredicts) {
  const Said said = run("", 1.1);
  EXPECT_GT(said.tip.y(), 0.05) << "the finger must push the stem";
  expect_alike("");
}

TEST_F(RunOfScene, EffectsActAsTheDiagnosisMeansThem) {
  for (const char* effects :
       {"{name: plant_pose, offset: [0.002, -0.006, 0], yaw: 0.3}",
        "{name: tool_pose, offset: [0, 0.008, 0], rotation: [0, 0, 0.05]}",
        "{name: joint_offset, joint: turn, offset: 0.015}", "{name: reaction, joint_stiffness: 30}",
        "{name: payload, mass: 0.1, centre: [0, 0.01, 0.02]}",
        "{name: wrench_bias, force: [0.3, 0, -0.2], moment: [0, 0.02, 0]}",
        "{name: wrench_gain, gain: 1.4}", "{name: base_compliance, stiffness: 5}",
        "{name: youngs_modulus, factor: 0.5}"})
    expect_alike(effects);
}

TEST_F(RunOfScene, ALateLogIsFollowedAheadOfItsTimes) {
  expect_alike("{name: robot_latency, delay: 0.05}", 0.6);
  EXPECT_NEAR(run("{name: robot_latency, delay: 0.05}", 0.6).nail.y(),
              ArmAtStem::reach * std::sin(at_.joint(0.65)), 1.0e-3);
}

TEST_F(RunOfScene, AControllerLagsBehindByItsTimeAtAnEvenPace) {
  at_.gap = "0.2";
  const double late = run("", 0.5).nail.y() - run("{name: tracking_lag, time: 0.01}", 0.5).nail.y();
  const double speed = (at_.joint(0.501) - at_.joint(0.499)) / 0.002 * ArmAtStem::reach;
  EXPECT_NEAR(late, 0.01 * speed, 0.15 * 0.01 * speed);
}

TEST_F(RunOfScene, EncodersReadTheMotorsSideOfJointsThatGiveWay) {
  const Said said = run("{name: reaction, joint_stiffness: 30}", 1.1);
  EXPECT_NEAR(said.reading, at_.joint(1.1), 1.0e-3);
  EXPECT_LT(std::atan2(said.nail.y(), said.nail.x()), at_.joint(1.1) - 5.0e-3);
}

TEST_F(RunOfScene, FrictionOfOneLinkIsTheCollidersOwn) {
  const simulation::Simulation simulation(
      scene("{name: contact_friction, coefficient: 0.9, link: finger}"), {});
  for (int c = 0; c < simulation.colliders().size(); ++c) {
    const coupling::Collider& one = simulation.colliders().collider(c);
    if (one.link == simulation.robot()->description().link("finger"))
      EXPECT_DOUBLE_EQ(one.friction.value_or(0.0), 0.9);
    else
      EXPECT_FALSE(one.friction.has_value());
  }
  const simulation::SceneAssets soft(scene("{name: contact_compliance, stiffness: 700}"), {});
  EXPECT_DOUBLE_EQ(soft.coupling.contact_stiffness, 700.0);
  const simulation::SceneAssets smooth(scene("{name: contact_friction, factor: 0.5}"), {});
  EXPECT_DOUBLE_EQ(smooth.coupling.friction, 0.25);
}

TEST_F(RunOfScene, ASceneKeepsItsEffectsWhereItIsWritten) {
  const world::Scene first = scene("{name: contact_friction, coefficient: 0.9, link: finger}");
  ASSERT_EQ(first.effects.size(), 1u);
  const std::string text = world::scene_text(first, at_.path());
  EXPECT_NE(text.find("  - {name: contact_friction, coefficient: 0.9, link: finger}\n"),
            std::string::npos)
      << text;
  Diagnostics diagnostics;
  const auto again = world::parse_scene(text, at_.path() / "again.scene.yaml", diagnostics);
  ASSERT_TRUE(again) << diagnostics.text();
  EXPECT_EQ(world::scene_text(*again, at_.path()), text);
}

TEST_F(RunOfScene, FaultsOfEffectsStandAtTheirPlaceInTheFile) {
  const auto fault = [&](const std::string& effects) -> std::string {
    try {
      const simulation::SceneAssets assets(scene(effects), {});
    } catch (const InvalidFile& invalid) {
      return invalid.what();
    }
    return "none";
  };
  // The effects come in the last line of the file.
  const std::string unknown = fault("{name: contact_friction, coefficient: -1}");
  EXPECT_NE(unknown.find("scene.yaml:15:43: error"), std::string::npos) << unknown;
  EXPECT_NE(fault("{name: no_such_effect}").find("scene.yaml:15:"), std::string::npos);
  EXPECT_NE(fault("{name: joint_offset, offset: 0.1, joint: elbow}").find("elbow"),
            std::string::npos);
  EXPECT_NE(fault("{name: extra_mass, mass: 0.01, where: {curve: twig, at: 1}}").find("twig"),
            std::string::npos);
}

TEST_F(RunOfScene, WhatIsAboutMeasuredDataIsSaidToChangeNothing) {
  const simulation::Simulation simulation(scene("{name: latency, delay: 0.01}"), {});
  ASSERT_FALSE(simulation.notes().empty());
  EXPECT_NE(simulation.notes().front().find("latency"), std::string::npos);
  const simulation::Simulation seen(scene("{name: camera_focal, factor: 1.1}"), {});
  ASSERT_FALSE(seen.notes().empty());
  EXPECT_NE(seen.notes().front().find("measured images"), std::string::npos);
}

}  // namespace
}  // namespace pedicel::app
