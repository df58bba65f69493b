#include <gmock/gmock.h>

#include "engine/core/check.h"
#include "engine/io/text_file.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/files/experiment_lists.h"
#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/scene_predict/scene_observe.h"
#include "tests/support/described_keys.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {
namespace {

using testing::HasSubstr;

class SceneExperimentFiles : public testing::Test {
 protected:
  // What is said of a folder in which one thing was changed.
  std::string fault() {
    Diagnostics diagnostics;
    const auto experiment = read_experiment(at_.path(), diagnostics);
    EXPECT_NE(experiment.has_value(), diagnostics.has_errors());
    return diagnostics.text();
  }
  std::string fault_with(const std::string& text, const std::string& instead) {
    at_.write_all();
    std::string all = at_.head + at_.instruments + at_.trials;
    const std::size_t place = all.find(text);
    EXPECT_NE(place, std::string::npos) << text;
    at_.write("experiment.yaml", all.replace(place, text.size(), instead));
    return fault();
  }
  ArmAtStem at_;
};

TEST_F(SceneExperimentFiles, AWholeFolderIsRead) {
  at_.write_all();
  const Experiment experiment = at_.read();
  EXPECT_EQ(experiment.markers.size(), 3u);
  EXPECT_EQ(experiment.markers[1].plant, 0);
  EXPECT_EQ(experiment.markers[2].link, experiment.robot.link("finger"));
  EXPECT_EQ(experiment.cameras[0].size[0], 1280);
  EXPECT_EQ(experiment.trials[0].joints.size(), 121);
  EXPECT_NEAR(experiment.trials[0].duration(), 1.2, 1e-9);
  EXPECT_EQ(experiment.noise.joint_std, 2e-5);
}

TEST_F(SceneExperimentFiles, EyeTargetAndFieldOfViewAreACamera) {
  at_.write_all();
  std::string all = at_.head + at_.instruments + at_.trials;
  const std::size_t begin = all.find("  - {name: left"), end = all.find('\n', begin);
  all.replace(begin, end - begin,
              "  - {name: left, eye: [0.4, -1, 0.3], target: [0.4, 0, 0.3], fov: 0.7, size: "
              "[1280, 720]}");
  at_.write("experiment.yaml", all);
  const Experiment experiment = at_.read();
  const Camera& camera = experiment.cameras[0];
  EXPECT_NEAR(camera.focal.x(), 360.0 / std::tan(0.35), 1e-9);
  EXPECT_LT((camera.X_WC.rotation * Vec3::UnitZ() - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_LT((camera.X_WC.rotation * Vec3::UnitY() + Vec3::UnitZ()).norm(), 1e-12);
}

TEST_F(SceneExperimentFiles, FaultsAreToldWithTheirPlace) {
  EXPECT_THAT(fault_with("link: finger, offset", "link: thumb, offset"),
              HasSubstr("experiment.yaml:8:24: error: link \"thumb\" is unknown, expected one of: "
                        "base, arm, finger"));
  EXPECT_THAT(fault_with("plant: bush", "plant: tree"),
              HasSubstr("plant \"tree\" is unknown, expected one of: bush"));
  EXPECT_THAT(fault_with("curve: stem, at: 0.6", "curve: twig, at: 0.6"),
              HasSubstr("curve \"twig\" is unknown, expected one of: stem"));
  EXPECT_THAT(fault_with("focal: [1000, 1000]", "focal: [1000]"),
              HasSubstr("focal: expected two numbers, px"));
  EXPECT_THAT(fault_with("follows: joints", "follows: me"), HasSubstr("joints"));
  EXPECT_THAT(fault_with("joint_std: 0.00002", "joint_std: -1"), HasSubstr("joint_std"));
  EXPECT_THAT(fault_with("title:", "titel:"), HasSubstr("titel"));
  EXPECT_THAT(fault_with("scene: scene.yaml", "scene: nothing.yaml"), HasSubstr("nothing.yaml"));
  EXPECT_THAT(fault_with("{name: middle", "{name: tip"), HasSubstr("appears twice"));
  EXPECT_THAT(fault_with("trials:\n",
                         "effects: [{name: wrench_gain, gain: 1.1, wrench: ankle}]\n"
                         "trials:\n"),
              HasSubstr("wrench \"ankle\" is unknown, expected one of: wrist"));
}

TEST_F(SceneExperimentFiles, EveryKeyThatIsDescribedIsRead) {
  at_.write_all();
  const KeyPlaces places = {{"experiment", {"%"}},
                            {"marker", {"markers: [{%}]", "markers: [{link: finger, %}]"}},
                            {"place", {"markers: [{%}]"}},
                            {"camera", {"cameras: [{%}]", "cameras: [{eye: [0, 0, 0], %}]"}},
                            {"wrench", {"wrenches: [{%}]"}},
                            {"noise", {"noise: {%}"}},
                            {"trial", {"trials: [{%}]"}},
                            {"follows", {"trials: [{robot: {%}}]"}},
                            {"mass", {"trials: [{masses: [{%}]}]"}},
                            {"moved", {"trials: [{plants: {bush: {%}}}]"}}};
  expect_every_key_is_read(lists_without(experiment_keys(), {"drive", "hold", "load", "base"}),
                           places, [&](const std::string&, const std::string& text) {
                             at_.write("experiment.yaml", at_.head + text);
                             Diagnostics diagnostics;
                             read_experiment(at_.path(), diagnostics);
                             return diagnostics.text();
                           });
}

TEST_F(SceneExperimentFiles, FaultsOfTablesAreToldWithTheirPlace) {
  at_.write_all();
  at_.write("push/joints.csv", "time,turn\n0,0\n0.01,x\n");
  EXPECT_THAT(fault(), HasSubstr("joints.csv:3:6: error:"));
  at_.write_all();
  at_.write("push/joints.csv", "time,twist\n0,0\n");
  EXPECT_THAT(fault(), HasSubstr("joints.csv:1:6: error: column \"twist\" is unknown"));
  at_.write_all();
  at_.write("push/joints.csv", "time,turn\n0.05,0\n1.2,0.1\n");
  EXPECT_THAT(fault(), HasSubstr("expected none before the arm's log begins"));
  at_.write_all();
  at_.write("push/wrench_ankle.csv", "time,fx\n0,0\n");
  EXPECT_THAT(fault(), HasSubstr("a table of wrench \"ankle\", expected one of: wrist"));
  at_.write_all();
  at_.write("push/events.csv", "time,event,what,by\n0.5,eaten,stem,finger\n");
  EXPECT_THAT(fault(), HasSubstr("events.csv:2:5: error: event: \"eaten\""));
  at_.write_all();
  at_.write("push/events.csv", "time,event,what,by\n0.5,grasped,apple,finger\n");
  EXPECT_THAT(fault(), HasSubstr("events.csv:2:13: error: what: \"apple\""));
}

TEST_F(SceneExperimentFiles, ATableMayHaveSomeColumnsInOtherUnits) {
  at_.write_all();
  at_.write("push/markers.csv", "time,tip.y (mm),tip.x (mm)\n0,30,400\n0.5,,401\n");
  at_.write("push/joints.csv", "time (ms),turn (deg)\n0,0\n1200,18\n");
  const Experiment experiment = at_.read();
  const Samples& markers = experiment.trials[0].markers;
  EXPECT_DOUBLE_EQ(markers.value(0, 0), 0.4);
  EXPECT_DOUBLE_EQ(markers.value(0, 1), 0.03);
  EXPECT_TRUE(std::isnan(markers.value(0, 2)));
  EXPECT_TRUE(std::isnan(markers.value(1, 1)));
  EXPECT_NEAR(experiment.trials[0].joints.value(1, 0), M_PI / 10.0, 1e-12);
  EXPECT_DOUBLE_EQ(experiment.trials[0].joints.time[1], 1.2);
}

TEST_F(SceneExperimentFiles, WhatIsObservedIsReadBackAndFitsItsOwnModel) {
  at_.write_all();
  SceneObserveOptions options;
  options.numerics.dt = 2.0e-3;
  options.numerics.distance = 0.02;
  const Experiment made = observed_scene(at_.read(), {}, options);
  const TemporaryFolder out;
  write_experiment(out / "made", made);
  Diagnostics diagnostics;
  const auto back = read_experiment(out / "made", diagnostics);
  ASSERT_TRUE(back) << diagnostics.text();
  EXPECT_LT((back->trials[0].markers.value - made.trials[0].markers.value).norm(), 1e-12);
  EXPECT_EQ(back->trials[0].joints.size(), 121);
  // Noise of the stated size and nothing else is left.
  const SceneDataSet data(*back);
  const SceneReadings readings = readings_of(*back, {}, options.numerics);
  int kinds = 0;
  for (const Misfit& sum : data.sums(0, readings)) {
    if (sum.count == 0) continue;  // joints: they drive the arm
    EXPECT_NEAR(sum.rms(), 1.0, 0.2);
    ++kinds;
  }
  EXPECT_EQ(kinds, 5);
}

// As `import` leaves them: the scene deep in the folder, and what it names beside it.
TEST_F(SceneExperimentFiles, ASceneDeepInItsFolderIsWrittenWithWhatItNames) {
  at_.write_all();
  std::string scene = io::read_text_file(at_.path() / "scene.yaml");
  for (const std::string name : {"plant.yaml", "arm.urdf"}) {
    at_.write("model/parts/" + name, io::read_text_file(at_.path() / name));
    scene.replace(scene.find("file: " + name), 6 + name.size(), "file: ../parts/" + name);
  }
  at_.write("model/scenes/scene.yaml", scene);
  at_.write("experiment.yaml",
            "format: pedicel-experiment\nversion: 1\nscene: model/scenes/scene.yaml\n" +
                at_.instruments + at_.trials);
  const TemporaryFolder out;
  write_experiment(out / "made", at_.read());
  Diagnostics diagnostics;
  EXPECT_TRUE(read_experiment(out / "made", diagnostics)) << diagnostics.text();
  // A scene from elsewhere is carried along with its folders.
  const auto shipped =
      read_experiment(at_.path(), diagnostics, {.scene = at_.path() / "model/scenes/scene.yaml"});
  ASSERT_TRUE(shipped) << diagnostics.text();
  write_experiment(out / "other", *shipped);
  EXPECT_TRUE(read_experiment(out / "other", diagnostics)) << diagnostics.text();
  EXPECT_TRUE(std::filesystem::exists(out / "other/model/scenes/scene.yaml"));
  // Nothing is written outside of the folder.
  Experiment outside = *shipped;
  outside.scene.file = at_.path() / "scene.yaml";
  outside.robot = {};
  outside.scene.robot->file = at_.path() / "arm.urdf";
  outside.plants.front().path = at_.path() / "plant.yaml";
  outside.scene_path = "../scene.yaml";
  EXPECT_THROW(write_experiment(out / "third", outside), UsageError);
}

}  // namespace
}  // namespace pedicel::discrepancy
