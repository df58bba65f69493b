#include "plugins/discrepancy/data/experiment.h"

#include <gtest/gtest.h>

#include "engine/io/asset_folder.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/simulate/scales.h"
#include "plugins/discrepancy/simulate/variant_plant.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using testing::effect;
using testing::on_stem;

/// With everything that a folder can say.
Experiment full_experiment() {
  Experiment experiment = testing::experiment_of({}, 0.3, 0.1);
  experiment.title = "a: \"title\"";
  experiment.noise = {0.0003, 0.01};
  plant::Effect marker_offset = effect("marker_offset", "offset", {0.001, 0.0, 1.0 / 3.0});
  marker_offset.words["marker"] = "tip";
  experiment.effects = {marker_offset};
  Trial& trial = experiment.trials[0];
  trial.folder = "one";
  trial.use = Trial::Use::check;
  trial.clock = 12.5;
  trial.gravity = Vec3(0.1, 0, -9.8);
  trial.masses = {{on_stem(0.7), 0.02}};
  trial.effects = {effect("latency", "delay", {0.03})};
  trial.holds = {
      {on_stem(0.8), {{0.0, 0.1}, {Vec3(0, 0, 0.3), Vec3(1.0 / 7.0, 0, 0.3)}, {}}, 0.2, 150.0},
      {on_stem(0.5), {{0.0}, {Vec3(0, 0, 0.2)}, {Quat::Identity()}}, INFINITY, {}}};
  trial.loads = {{on_stem(1.0), Vec3(0, 0, -0.2), 0.1, 0.2}, {on_stem(1.0), Vec3(5e8, 0, 0)}};
  trial.base = DrivenPath{{0.0, 0.3}, {Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, {}};
  trial.markers.value.setRandom();
  trial.markers.value.row(2).head<3>().setConstant(NAN);
  trial.force.value.row(1).setConstant(NAN);
  plant::PlantFruit fruit;
  fruit.name = "fruit_1";
  fruit.place = on_stem(1.0);
  fruit.radius = 0.01;
  fruit.density = 900.0;
  experiment.plant().fruits = {fruit};
  trial.events = {{0.11, "detached", "fruit_1"}};
  Trial still = trial;
  still.name = "two";
  still.folder = "two";
  still.use = Trial::Use::unset;
  still.holds.clear();
  still.loads.clear();
  still.base.reset();
  still.force = {};
  still.events.clear();
  experiment.trials.push_back(still);
  return experiment;
}

void expect_equal(const DrivenPath& a, const DrivenPath& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.position, b.position);
  ASSERT_EQ(a.rotation.size(), b.rotation.size());
  for (std::size_t i = 0; i < a.rotation.size(); ++i)
    EXPECT_EQ(a.rotation[i].coeffs(), b.rotation[i].coeffs());
}

void expect_equal(const Samples& a, const Samples& b) {
  EXPECT_EQ(a.time, b.time);
  if (a.size() == 0) return;
  ASSERT_EQ(a.value.cols(), b.value.cols());
  EXPECT_TRUE(
      ((a.value.array() == b.value.array()) || (a.value.array().isNaN() && b.value.array().isNaN()))
          .all());
}

void expect_equal(const Trial& a, const Trial& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.folder, b.folder);
  EXPECT_EQ(a.use, b.use);
  EXPECT_EQ(a.clock, b.clock);
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.masses, b.masses);
  EXPECT_EQ(a.effects, b.effects);
  ASSERT_EQ(a.holds.size(), b.holds.size());
  for (std::size_t i = 0; i < a.holds.size(); ++i) {
    EXPECT_EQ(a.holds[i].place, b.holds[i].place);
    EXPECT_EQ(a.holds[i].release, b.holds[i].release);
    EXPECT_EQ(a.holds[i].stiffness, b.holds[i].stiffness);
    expect_equal(a.holds[i].path, b.holds[i].path);
  }
  ASSERT_EQ(a.loads.size(), b.loads.size());
  for (std::size_t i = 0; i < a.loads.size(); ++i) {
    EXPECT_EQ(a.loads[i].place, b.loads[i].place);
    EXPECT_EQ(a.loads[i].force, b.loads[i].force);
    EXPECT_EQ(a.loads[i].from, b.loads[i].from);
    EXPECT_EQ(a.loads[i].to, b.loads[i].to);
  }
  ASSERT_EQ(a.base.has_value(), b.base.has_value());
  if (a.base) expect_equal(*a.base, *b.base);
  expect_equal(a.markers, b.markers);
  expect_equal(a.force, b.force);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    EXPECT_EQ(a.events[i].time, b.events[i].time);
    EXPECT_EQ(a.events[i].event, b.events[i].event);
    EXPECT_EQ(a.events[i].what, b.events[i].what);
  }
}

TEST(Experiment, WhatIsWrittenReadsBackTheSame) {
  const Experiment written = full_experiment();
  const TemporaryFolder folder;
  write_experiment(folder / "x", written);
  Diagnostics diagnostics;
  const auto read = read_experiment(folder / "x", diagnostics);
  ASSERT_TRUE(read) << diagnostics.text();
  EXPECT_EQ(read->title, written.title);
  EXPECT_EQ(read->plant(), written.plant());
  EXPECT_EQ(read->noise.position_std, written.noise.position_std);
  EXPECT_EQ(read->noise.force_std, written.noise.force_std);
  EXPECT_EQ(read->effects, written.effects);
  ASSERT_EQ(read->markers.size(), written.markers.size());
  for (std::size_t m = 0; m < read->markers.size(); ++m) {
    EXPECT_EQ(read->markers[m].name, written.markers[m].name);
    EXPECT_EQ(read->markers[m].place, written.markers[m].place);
  }
  ASSERT_EQ(read->trials.size(), 2u);
  for (int t = 0; t < 2; ++t) expect_equal(read->trials[t], written.trials[t]);
  EXPECT_TRUE(read_experiment(folder / "x/experiment.yaml", diagnostics));
}

// Without `release` a hold lasts as long as its path does.
TEST(Experiment, AHoldWithoutReleaseEndsWithItsPath) {
  Experiment experiment = full_experiment();
  experiment.trials[0].holds[0].release = INFINITY;
  const TemporaryFolder folder;
  write_experiment(folder / "x", experiment);
  Diagnostics diagnostics;
  const auto read = read_experiment(folder / "x", diagnostics);
  ASSERT_TRUE(read) << diagnostics.text();
  EXPECT_EQ(read->trials[0].holds[0].release, 0.1);
  EXPECT_EQ(read->trials[0].holds[1].release, INFINITY);  // one row: a place, no path
}

// Everything that builds its plant finds them: scales, starts and variants.
TEST(Experiment, FindsTheLeavesOfItsPlantAndTakesThemAlong) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "leaves");
  std::filesystem::copy_file(io::asset_folder() / "leaves/tomato.leaf.yaml",
                             folder / "leaves/own.leaf.yaml");
  Experiment experiment = full_experiment();
  plant::PlantLeaf leaf;
  leaf.name = "leaf_1";
  leaf.place = on_stem(0.8);
  leaf.leaf_template = "own";
  leaf.size = 0.05;
  experiment.plant().leaves = {leaf};
  experiment.plant().leaf_folders = {folder / "leaves"};
  write_experiment(folder / "x", experiment);
  std::filesystem::remove_all(folder / "leaves");

  Diagnostics diagnostics;
  const auto read = read_experiment(folder / "x", diagnostics);
  ASSERT_TRUE(read) << diagnostics.text();
  ASSERT_EQ(read->plant().leaves.size(), 1u);
  EXPECT_GT(scales_of(*read).mass, scales_of(full_experiment()).mass);
  EXPECT_NO_THROW(junction_nuisance(*read, {}));
  EXPECT_NO_THROW(PlantMaker(*read, read->plant().distance, 0.0));
}

TEST(DrivenPath, IsLinearBetweenItsRowsAndKeptBeyond) {
  const DrivenPath path{{1.0, 2.0, 4.0},
                        {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 4, 0)},
                        {Quat::Identity(), Quat(Eigen::AngleAxisd(1.0, Vec3::UnitZ())),
                         Quat(Eigen::AngleAxisd(1.0, Vec3::UnitZ()))}};
  EXPECT_EQ(path.position_at(-3.0), Vec3(0, 0, 0));
  EXPECT_EQ(path.position_at(1.5), Vec3(0.5, 0, 0));
  EXPECT_EQ(path.position_at(2.0), Vec3(1, 0, 0));
  EXPECT_EQ(path.position_at(2.5), Vec3(1, 1, 0));
  EXPECT_EQ(path.position_at(9.0), Vec3(1, 4, 0));
  EXPECT_NEAR(path.rotation_at(1.25).angularDistance(Quat::Identity()), 0.25, 1e-12);
  EXPECT_NEAR(path.rotation_at(5.0).angularDistance(Quat::Identity()), 1.0, 1e-12);
}

}  // namespace
}  // namespace pedicel::discrepancy
