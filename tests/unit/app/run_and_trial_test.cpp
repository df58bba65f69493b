// A trial is the run's own simulation, led by what was recorded: it goes as the run went.
#include <gtest/gtest.h>

#include "engine/world/scene_reader.h"
#include "plugins/simulation/colliders.h"
#include "plugins/simulation/link_wrench.h"
#include "plugins/simulation/simulation.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::app {
namespace {

using discrepancy::ArmAtStem;
using discrepancy::Experiment;
using discrepancy::Samples;

constexpr double dt = 1.0e-3;  // s, of the scene
constexpr int steps = 1100;

/// What a run did, step by step.
struct Recorded {
  Eigen::VectorXd joint;         // rad
  Eigen::MatrixXd tip;           // m, W
  std::vector<double> touching;  // N, of the stem on the finger
  Eigen::MatrixXd wrench;        // N and N m, in the finger's wrist
  std::vector<double> detached;  // s
};

class RunAndTrial : public testing::Test {
 protected:
  Recorded run() {
    at_.write_all();
    std::string log = "time_s,turn\n";
    for (int i = 0; i <= steps; ++i) {
      char row[60];
      std::snprintf(row, sizeof row, "%.3f,%.12f\n", dt * i, at_.joint(dt * i));
      log += row;
    }
    at_.write("log.csv", log);
    Diagnostics diagnostics;
    auto scene = world::read_scene(at_.path() / "scene.yaml", diagnostics);
    if (!scene) throw InvalidFile(diagnostics);
    scene->robot->trajectory = at_.path() / "log.csv";
    simulation::Simulation simulation(*scene, {});
    Recorded out;
    out.joint.resize(steps + 1);
    out.tip.resize(steps + 1, 3);
    const int finger = simulation.robot()->description().link("finger");
    simulation::LinkWrench wrist(simulation, finger);
    out.wrench.setZero(steps + 1, 6);
    for (int k = 0; k <= steps; ++k) {
      if (k > 0) {
        EXPECT_EQ(simulation.step().errors, 0u);
        out.wrench.row(k) = wrist.carried().transpose();
        for (int p = 0; p < simulation.rods().size(); ++p)
          for (std::size_t d = 0; d < simulation.rods().detached(p).size(); ++d)
            out.detached.push_back(dt * k);
      }
      out.joint[k] = simulation.robot()->robot().positions()[0];
      const cosserat::RodModel& model = simulation.rods().model(0);
      out.tip.row(k) =
          cosserat::point_on(model, simulation.rods().state(0), model.size() - 1, 0.0).transpose();
      out.touching.push_back(simulation.plant_step()
                                 .contacts()
                                 .sum_of_link(simulation::robot_body, finger)
                                 .force_W.norm());
    }
    return out;
  }

  /// The same scene as an experiment that is a log of that run.
  Experiment experiment(const Recorded& recorded) const {
    Experiment made = at_.read();
    made.is_run = true;
    discrepancy::Trial& trial = made.trials.front();
    const auto table = [](long columns) {
      Samples samples;
      for (int k = 0; k <= steps; ++k) samples.time.push_back(dt * k);
      samples.value.setConstant(steps + 1, columns, 0.0);
      return samples;
    };
    trial.joints = table(1);
    trial.joints.value.col(0) = recorded.joint;
    trial.markers = table(trial.markers.value.cols());
    trial.torques = {};
    trial.pixels.assign(made.cameras.size(), {});
    // A run's log tells the wrench of a step in the step's middle.
    trial.wrenches = {table(6)};
    for (double& time : trial.wrenches.front().time) time -= 0.5 * dt;
    return made;
  }

  void expect_the_same(double tolerance) {
    const Recorded ran = run();
    EXPECT_GT(*std::ranges::max_element(ran.touching), 0.05) << "the finger must push the stem";
    const Experiment made = experiment(ran);
    const discrepancy::SceneReadings found = discrepancy::readings_of(made);
    ASSERT_TRUE(found.healthy);
    for (int k = 0; k <= steps; k += 25)
      ASSERT_LT((found.markers.row(k).head<3>() - ran.tip.row(k)).norm(), tolerance)
          << "at " << dt * k << " s, " << ran.touching[static_cast<std::size_t>(k)] << " N";
    for (int k = 1; k <= steps; ++k)
      ASSERT_LT((found.wrenches.front().row(k) - ran.wrench.row(k)).norm(), 1.0e5 * tolerance)
          << "at " << dt * k << " s: " << ran.wrench.row(k);
    ASSERT_EQ(found.events.size(), ran.detached.size());
    for (std::size_t d = 0; d < ran.detached.size(); ++d)
      EXPECT_NEAR(found.events[d].time, ran.detached[d], 1.0e-9);
  }

  ArmAtStem at_;
};

TEST_F(RunAndTrial, AgreeWithTheRunsOwnContact) {
  at_.coupling = "{friction: 0.5}";
  expect_the_same(1.0e-7);
}

TEST_F(RunAndTrial, AgreeWithStiffContact) {
  at_.coupling = "{friction: 0.3, contact_stiffness: 1.0e6, margin: 1.0e-5}";
  expect_the_same(1.0e-7);
}

TEST_F(RunAndTrial, AgreeWithSoftContact) {
  at_.coupling = "{friction: 0.8, contact_stiffness: 1.0e4}";
  expect_the_same(1.0e-7);
}

TEST_F(RunAndTrial, AgreeWhereTheStemLeansOnTheArmFromTheStart) {
  at_.gap = "0.008";
  expect_the_same(1.0e-7);
}

TEST_F(RunAndTrial, AgreeWhereAStringHoldsTheStem) {
  at_.scene_more = "ties:\n  - {organ: bush/stem, at: 1.0, offset: [0, 0, 0.4]}\n";
  expect_the_same(1.0e-7);
}

TEST_F(RunAndTrial, AgreeInWind) {
  at_.scene_more =
      "wind: {velocity: [2, 0, 0], height: 2, roughness: 0.05, intensity: 0.3, length: 1}\n";
  expect_the_same(1.0e-7);
}

}  // namespace
}  // namespace pedicel::app
