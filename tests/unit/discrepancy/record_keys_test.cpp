// Optional keys and tables for records as people make them: read, refused with their place, and
// written so that they read back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;
using testing::on_stem;

class RecordKeys : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    io::write_file_atomically(folder_ / file, text);
  }
  /// A folder with one trial, whose keys and drives are given.
  void write_experiment_of(const std::string& keys, const std::string& drives,
                           const std::string& noise = "{position_std: 0.001}") {
    plant::write_plant_file(folder_ / "plant.yaml", testing::plant_of({}));
    write("one/markers.csv", "time,tip.x,tip.y,tip.z\n0,0,0,0.4\n0.05,0,0,0.4\n0.1,0,0,0.4\n");
    write("one/hold.csv", "time,x,y,z\n0,0,0,0.4\n0.1,0.01,0,0.4\n");
    write("experiment.yaml",
          "format: pedicel-experiment\nversion: 1\nplant: plant.yaml\n"
          "markers:\n  - {name: tip, curve: stem, at: 1.0}\nnoise: " +
              noise + "\ntrials:\n  - name: one\n    folder: one\n" + keys + "    drive:\n" +
              drives);
  }
  std::optional<Experiment> read() {
    diagnostics_ = {};
    return read_experiment(folder_ / "", diagnostics_);
  }
  Experiment good() {
    auto experiment = read();
    EXPECT_TRUE(experiment) << diagnostics_.text();
    return experiment.value_or(Experiment{});
  }
  void expect_fault(const std::string& said) {
    EXPECT_FALSE(read());
    EXPECT_THAT(diagnostics_.text(), HasSubstr(said));
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

std::string hold(const std::string& keys) {
  return "      - {kind: hold, curve: stem, at: 1.0, path: hold.csv" + keys + "}\n";
}

TEST_F(RecordKeys, ABeginningInMotion) {
  write_experiment_of("    begins: moving\n    window: 0.15\n", hold(""));
  EXPECT_EQ(good().trials[0].window, 0.15);
  write_experiment_of("    begins: moving\n", hold(""));
  EXPECT_EQ(good().trials[0].window, 0.2);
  write_experiment_of("    begins: at_rest\n", hold(""));
  EXPECT_FALSE(good().trials[0].window);
  write_experiment_of("    window: 0.15\n", hold(""));
  expect_fault("experiment.yaml:10:13: error: a window where the trial begins at rest");
  write_experiment_of("    begins: running\n", hold(""));
  expect_fault("experiment.yaml:10:13: error: ");
  write_experiment_of("    begins: moving\n    window: 0\n", hold(""));
  expect_fault("experiment.yaml:11:13: error: ");
  write_experiment_of("    begins: moving\n    window: 0.06\n", hold(""));
  expect_fault("markers.csv: error: has 2 rows up to 0.06 s, the window of a trial");
}

TEST_F(RecordKeys, WhatAHoldLeads) {
  write_experiment_of("", hold(", axes: [z, x]"));
  const Hold both = good().trials[0].holds[0];
  ASSERT_EQ(both.axes.size(), 2u);
  EXPECT_EQ(both.axes[0], Vec3(0, 0, 1));
  EXPECT_EQ(both.axes[1], Vec3(1, 0, 0));
  EXPECT_FALSE(both.one_sided);
  write_experiment_of("", hold(", axis: [0.6, -0.8, 0], one_sided: true"));
  const Hold pusher = good().trials[0].holds[0];
  ASSERT_EQ(pusher.axes.size(), 1u);
  EXPECT_LT((pusher.axes[0] - Vec3(0.6, -0.8, 0)).norm(), 1e-12);
  EXPECT_TRUE(pusher.one_sided);
  write_experiment_of("", hold(", axes: [x, y, z]"));
  EXPECT_FALSE(good().trials[0].holds[0].slides());

  const auto refused = [&](const std::string& keys, const std::string& said) {
    write_experiment_of("", hold(keys));
    expect_fault(said);
  };
  refused(", axes: [x, w]", "error: axes is \"w\"");
  refused(", axes: [x, x]", "error: axis x appears twice, expected it once");
  refused(", axes: []", "error: no axes, expected one or more of x, y and z");
  refused(", axes: [x], axis: [0, 1, 0]", "error: axes beside axis, expected one of the two");
  refused(", axis: [0, 2, 0]", "error: axis has the length 2, expected a unit vector");
  refused(", one_sided: true", "error: one_sided: true, and the hold leads along all axes");
  refused(", axes: [x, y], one_sided: true", "the hold leads along several axes");
  refused(", direction: true", "error: direction: true, and the path has no orientation");
  refused(", sliding: true", "error: unknown key \"sliding\"");
}

TEST_F(RecordKeys, AnAxisOrTwoOfAMarkerAndAForce) {
  write_experiment_of("", hold(""));
  write("one/markers.csv", "time,tip.x,tip.z\n0,0,0.4\n0.1,,\n");
  write("one/force.csv", "time,fy\n0,1.5\n");
  const Trial trial = good().trials[0];
  EXPECT_EQ(trial.markers.value(0, 2), 0.4);
  EXPECT_TRUE(trial.markers.value.col(1).array().isNaN().all());
  EXPECT_EQ(trial.force.value(0, 1), 1.5);
  EXPECT_TRUE(std::isnan(trial.force.value(0, 0)));
  write("one/markers.csv", "time,tip.x,tip.z\n0,0,\n");
  expect_fault(
      "markers.csv:2:5: error: tip.z is empty where the other axes are not, expected all "
      "two or none");
  write("one/markers.csv", "time\n0\n");
  expect_fault("markers.csv:1:1: error: no column tip.x, tip.y, tip.z, expected time and x, y, z");
}

TEST_F(RecordKeys, ForceAndMomentAtTheRoot) {
  write_experiment_of("", "      - {kind: base, wrench: base_wrench.csv}\n",
                      "{force_std: 0.01, moment_std: 0.002, path_std: 0.0004}");
  write("one/base_wrench.csv", "time,fx,fy,fz,tx (N mm),ty,tz\n0,1,2,3,4000,5,6\n0.1,,,,,,\n");
  const Experiment experiment = good();
  EXPECT_EQ(experiment.noise.moment_std, 0.002);
  EXPECT_EQ(experiment.noise.path_std, 0.0004);
  const Trial& trial = experiment.trials[0];
  EXPECT_FALSE(trial.base);
  ASSERT_EQ(trial.wrench.size(), 2);
  EXPECT_EQ(trial.wrench.value(0, 2), 3.0);
  EXPECT_DOUBLE_EQ(trial.wrench.value(0, 3), 4.0);
  EXPECT_TRUE(std::isnan(trial.wrench.value(1, 5)));
  write("one/base_wrench.csv", "time,fz\n0,3\n");
  EXPECT_EQ(good().trials[0].wrench.value(0, 2), 3.0);
  write("one/base_wrench.csv", "time,mx\n0,3\n");
  expect_fault("base_wrench.csv:1:6: error: column \"mx\" is unknown");
  write_experiment_of("", "      - {kind: base, wrench: none.csv}\n");
  expect_fault("none.csv");
}

TEST_F(RecordKeys, AStaticSeries) {
  const std::string keys = "    static: true\n";
  write_experiment_of(keys, hold(""));
  write("one/markers.csv", "tip.x,tip.y,tip.z\n0,0,0.4\n0.01,0,0.39\n0.02,0,0.38\n");
  write("one/hold.csv", "x,y,z\n0,0,0.4\n0.01,0,0.4\n0.02,0,0.4\n");
  const Trial trial = good().trials[0];
  EXPECT_TRUE(trial.is_static);
  EXPECT_EQ(trial.markers.time, (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(trial.holds[0].path.time.back(), 2.0);
  EXPECT_FALSE(std::isfinite(trial.holds[0].release));
  // A time that is there says nothing, whatever it is.
  write("one/hold.csv", "time,x,y,z\n5,0,0,0.4\n5,0.01,0,0.4\n5,0.02,0,0.4\n");
  good();
  EXPECT_THAT(diagnostics_.text(), HasSubstr("hold.csv:1:1: notice: column \"time\" is not read"));
  write("one/hold.csv", "x,y,z\n0,0,0.4\n");  // it stays there
  good();
  write("one/hold.csv", "x,y,z\n0,0,0.4\n0,0,0.4\n");
  expect_fault("hold.csv: error: has 2 rows, and markers.csv has 3: expected as many");
  write_experiment_of(keys, hold(", release: 0.1"));
  expect_fault("error: a static series with a release");
  write_experiment_of(keys + "    begins: moving\n", hold(""));
  expect_fault("error: begins: moving in a static series");
  write_experiment_of(keys, hold(""), "{force_std: 0.01}");
  expect_fault("experiment.yaml:8:5: error: a static series where noise has no position_std");
  write_experiment_of("    static: perhaps\n", hold(""));
  expect_fault("experiment.yaml:10:13: error: ");
}

TEST_F(RecordKeys, AllOfItReadsBack) {
  Experiment experiment = testing::experiment_of({}, 0.3, 0.1);
  experiment.noise = {0.001, 0.01, 0.002, 0.0005};
  Trial moving = experiment.trials[0];
  moving.window = 0.22;
  moving.markers.value.col(1).setConstant(NAN);
  moving.markers.value.row(2).setConstant(NAN);
  Hold pusher{on_stem(1.0), {{0.0, 0.1}, {Vec3(0, 0, 0.4), Vec3(0.01, 0, 0.4)}, {}}, 0.2, {}};
  pusher.axes = {Vec3(0.6, 0.8, 0)};
  pusher.one_sided = true;
  Hold guide = pusher;
  guide.one_sided = false;
  guide.axes = {Vec3::UnitX(), Vec3::UnitZ()};
  guide.path.rotation = {Quat::Identity(), Quat::Identity()};
  guide.direction = true;
  moving.holds = {pusher, guide};
  moving.wrench = testing::empty_samples(0.3, 0.1, 6);
  moving.wrench.value.col(4).setConstant(NAN);
  Trial still = testing::experiment_of({}, 2.0, 1.0).trials[0];
  still.name = "two";
  still.is_static = true;
  still.force = {};
  still.holds = {{on_stem(1.0),
                  {{0.0, 1.0, 2.0}, {Vec3(0, 0, 0.4), Vec3(0.01, 0, 0.4), Vec3(0.02, 0, 0.4)}, {}},
                  INFINITY,
                  {}}};
  experiment.trials = {moving, still};
  write_experiment(folder_ / "", experiment);
  const Experiment found = good();
  EXPECT_EQ(found.noise.moment_std, experiment.noise.moment_std);
  EXPECT_EQ(found.noise.path_std, experiment.noise.path_std);
  ASSERT_EQ(found.trials.size(), 2u);
  const Trial& one = found.trials[0];
  EXPECT_EQ(one.window, 0.22);
  EXPECT_TRUE(one.markers.value.col(1).array().isNaN().all());
  EXPECT_EQ(one.markers.value(1, 0), moving.markers.value(1, 0));
  ASSERT_EQ(one.holds.size(), 2u);
  EXPECT_LT((one.holds[0].axes.at(0) - pusher.axes[0]).norm(), 1e-12);
  EXPECT_TRUE(one.holds[0].one_sided);
  EXPECT_EQ(one.holds[1].axes, guide.axes);
  EXPECT_TRUE(one.holds[1].direction);
  EXPECT_FALSE(one.base);
  ASSERT_EQ(one.wrench.size(), 4);
  EXPECT_TRUE(one.wrench.value.col(4).array().isNaN().all());
  EXPECT_EQ(one.wrench.value(0, 5), 0.0);
  EXPECT_TRUE(found.trials[1].is_static);
  EXPECT_EQ(found.trials[1].markers.time, still.markers.time);
  EXPECT_EQ(found.trials[1].holds[0].path.time, still.holds[0].path.time);
}

}  // namespace
}  // namespace pedicel::discrepancy
