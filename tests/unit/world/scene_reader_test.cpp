#include "engine/world/scene_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/atomic_file.h"
#include "engine/world/scene_writer.h"

namespace pedicel::world {
namespace {

const char* const text = R"(format: pedicel-scene
version: 1
purpose: shows that every key is read
see: nothing
duration: 2
dt: 0.002
seed: 4
threads: 2
gravity: [0, 0, -1.62]
rods: {newton_iterations: 6, solver: direct}
coupling: {friction: 0.8}
plants:
  - name: truss
    file: a.plant.yaml
    position: [0.4, 0, 0.5]
    repeat: {count: [2, 3], spacing: [0.5, 0.6]}
    set: {detach.stretch: 0.15}
  - {name: tree, mtg: gone.mtg, optional: true, fallback: a.plant.yaml}
  - {name: wood, built_in: forest}
robot:
  file: arm.urdf
  packages: {arm_description: ../arm}
  position: [0, 0, 0.1]
  joints: {joint1: 0.5}
  tool: tool0
  gripper: finger_joint
  waypoints:
    - {time: 0, position: [0.3, 0, 0.4], facing: {approach: [1, 0, 0]}, gripper: 0.03}
    - {time: 1, at: {fruit: truss_0/fruit_1}, offset: [-0.05, 0, 0]}
bodies:
  - {name: tray, tray: {size: [0.3, 0.2, 0.05], wall: 0.004}, position: [0.5, 0, 0]}
  - {name: ball, sphere: {radius: 0.02}, mass: 0.1, look: wood}
ground: {height: -0.1}
loads:
  - {fruit: truss_0/fruit_1, force: [0, 0, -3], from: 0.5, to: 1.5, ramp: true}
ties:
  - {organ: truss/stem, at: 0.9, offset: [0, 0, 1], length: 0.95, stiffness: 500}
  - {organ: tree/trunk, to: [0, 0.1, 1.5]}
  - {organ: truss/stem, to_organ: tree/trunk, to_at: 0.75}
cuts:
  - {organ: tree/trunk, at: 0.5, time: 2}
  - {organ: truss_0/stem, by_tool: true, reach: 0.03}
wind: {velocity: [3, 1, 0], height: 1.5, roughness: 0.02, intensity: 0.2, length: 4, rise: 0, shelter: false}
cameras:
  - {name: near, eye: [1, 0, 1], target: [0, 0, 0.5], fov: 0.5, follow: {fruit: truss_0/fruit_1}}
pictures:
  - {at: 0.5, camera: near}
  - {at: before_detachment, strain: true}
video: {fps: 24, size: [640, 360], camera: near}
sweep: {set: detach.stretch, values: [0.1, 0.2]}
expect:
  - {quantity: detached_count, is: 1}
  - {quantity: detach_time_s, fruit: truss_0/fruit_1, between: [0.5, 1.5]}
  - {quantity: detach_time_s, fruit: truss_0/fruit_1, with_sweep: rises}
  - {quantity: fruit_in, body: tray, is: true}
)";

class SceneReader : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) / "scene_reader";
    io::write_file_atomically(folder_ / "a.plant.yaml", "");
    io::write_file_atomically(folder_ / "arm.urdf", "");
  }
  std::filesystem::path folder_;
};

TEST_F(SceneReader, ReadsEveryKey) {
  Diagnostics diagnostics;
  const auto scene = parse_scene(text, folder_ / "try.scene.yaml", diagnostics);
  ASSERT_TRUE(scene) << diagnostics.text();
  EXPECT_EQ(scene->name, "try");
  EXPECT_EQ(scene->dt, 0.002);
  EXPECT_EQ(scene->gravity.z(), -1.62);
  EXPECT_EQ(scene->rods.at(1).text, "direct");
  ASSERT_EQ(scene->plants.size(), 3u);
  EXPECT_EQ(scene->plants[0].file, folder_ / "a.plant.yaml");
  EXPECT_EQ(scene->plants[0].repeat[1], 3);
  EXPECT_EQ(scene->plants[0].set.at(0).key, "detach.stretch");
  EXPECT_EQ(scene->plants[1].source, ScenePlant::Source::mtg);
  EXPECT_TRUE(scene->plants[1].optional);
  EXPECT_EQ(scene->plants[2].built_in, "forest");
  ASSERT_TRUE(scene->robot);
  EXPECT_EQ(scene->robot->packages.at(0).first, "arm_description");
  EXPECT_EQ(scene->robot->joints.at("joint1"), 0.5);
  ASSERT_EQ(scene->robot->waypoints.size(), 2u);
  EXPECT_EQ(scene->robot->waypoints[1].at.name, "truss_0/fruit_1");
  EXPECT_FALSE(scene->robot->waypoints[1].gripper);
  EXPECT_EQ(scene->bodies.at(0).parts.size(), 5u);
  EXPECT_EQ(scene->ground->height, -0.1);
  EXPECT_TRUE(scene->loads.at(0).ramp);
  EXPECT_TRUE(scene->ties.at(0).is_offset);
  EXPECT_EQ(scene->ties.at(0).length, 0.95);
  EXPECT_FALSE(scene->ties.at(1).length);
  EXPECT_EQ(scene->ties.at(2).to_organ, "tree/trunk");
  EXPECT_EQ(scene->ties.at(2).to_at, 0.75);
  EXPECT_EQ(scene->cuts.at(0).time, 2.0);
  EXPECT_FALSE(scene->cuts.at(1).time);
  EXPECT_EQ(scene->wind->length, 4.0);
  EXPECT_FALSE(scene->wind->shelter);
  EXPECT_EQ(scene->cameras.at(0).follow.kind, Anchor::Kind::fruit);
  EXPECT_EQ(scene->pictures.at(1).when, ScenePicture::When::before_detachment);
  EXPECT_TRUE(scene->pictures.at(1).strain);
  EXPECT_EQ(scene->video.size[1], 360);
  EXPECT_EQ(scene->sweep->values.size(), 2u);
  EXPECT_EQ(scene->expectations.at(2).test, Expectation::Test::rises_with_sweep);
  EXPECT_EQ(scene->expectations.at(3).low, 1.0);
}

// What is read is written, and read again the same.
TEST_F(SceneReader, WhatIsWrittenReadsAgain) {
  Diagnostics diagnostics;
  const auto scene = parse_scene(text, folder_ / "try.scene.yaml", diagnostics);
  ASSERT_TRUE(scene) << diagnostics.text();
  const std::string written = scene_text(*scene, folder_);
  const auto again = parse_scene(written, folder_ / "try.scene.yaml", diagnostics);
  ASSERT_TRUE(again) << diagnostics.text() << written;
  EXPECT_EQ(scene_text(*again, folder_), written);
  EXPECT_EQ(again->ties.size(), 3u);
  EXPECT_EQ(again->cuts.at(1).reach, 0.03);
  ASSERT_TRUE(again->wind);
  EXPECT_EQ(again->wind->roughness, 0.02);
  EXPECT_EQ(again->wind->rise, 0.0);
}

// Z of the tool along `approach`, Y along `across` (here the default, world Y).
TEST_F(SceneReader, FacingTurnsTheTool) {
  Diagnostics diagnostics;
  const auto scene = parse_scene(text, folder_ / "try.scene.yaml", diagnostics);
  ASSERT_TRUE(scene) << diagnostics.text();
  const Quat q = *scene->robot->waypoints[0].orientation;
  EXPECT_LT((q * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((q * Vec3::UnitY() - Vec3::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace pedicel::world
