#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/report/sensor_recorder.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "plugins/simulation/instrument.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {
namespace {

namespace fs = std::filesystem;
using Wrench = Eigen::Matrix<double, 6, 1>;

/// A hand on a vertical rail, turned by a quarter about Y, with a finger on it: 0.5 kg and 0.2 kg.
const char* const robot = R"(<robot name="lift">
  <link name="base"><inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="hand"><inertial><origin xyz="0.1 0.03 0"/><mass value="0.5"/><inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="finger"><inertial><origin xyz="0 0 0.05"/><mass value="0.2"/><inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.4 0.04 0.02"/></geometry></collision></link>
  <joint name="rail" type="prismatic"><parent link="base"/><child link="hand"/><origin xyz="0 0 1" rpy="0 1.5707963267948966 0"/>
    <axis xyz="-1 0 0"/><limit lower="-1" upper="1" effort="1000" velocity="2"/></joint>
  <joint name="fixed" type="fixed"><parent link="hand"/><child link="finger"/><origin xyz="0.2 0 0" rpy="0 -1.5707963267948966 0"/></joint>
</robot>)";

class WrenchTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("pedicel_wrench_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "lift.urdf") << robot;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::unique_ptr<simulation::Simulation> simulation(const std::string& wrenches,
                                                     const std::string& more = "") {
    Diagnostics diagnostics;
    const auto scene = world::parse_scene(
        "format: pedicel-scene\nversion: 1\npurpose: t\nsee: n\nduration: 1\ndt: 0.001\nseed: 2\n"
        "robot: {file: lift.urdf, joints: {rail: 0}}\nwrenches: [" +
            wrenches + "]\n" + more,
        folder_ / "t.scene.yaml", diagnostics);
    if (!scene) throw InvalidFile(diagnostics);
    return std::make_unique<simulation::Simulation>(*scene, simulation::SimulationOptions{});
  }

  fs::path folder_;
};

TEST_F(WrenchTest, AnArmAtRestIsFeltByItsWeight) {
  const auto sim = simulation("{name: wrist, link: hand}, {name: tip, link: finger}");
  for (int i = 0; i < 300; ++i) sim->step();
  // The hand's frame is turned by a quarter about Y: its X points down.
  const Wrench wrist = sim->instruments()[0]->exact(), tip = sim->instruments()[1]->exact();
  EXPECT_NEAR(wrist[0], 0.7 * 9.81, 1e-6);
  EXPECT_NEAR(wrist.segment<2>(1).norm(), 0.0, 1e-6);
  // The hand's mass is 30 mm beside its origin along Y, the finger's straight below it.
  EXPECT_LT((wrist.tail<3>() - Vec3(0, 0, -0.03 * 0.5 * 9.81)).norm(), 1e-6);
  EXPECT_LT((tip - (Wrench() << 0, 0, -0.2 * 9.81, 0, 0, 0).finished()).norm(), 1e-6);
}

TEST_F(WrenchTest, ABodyThatLiesOnAFingerIsFelt) {
  // The finger's box is level, its upper face 10 mm above its origin at a height of 0.8 m.
  const auto sim = simulation("{name: wrist, link: hand}, {name: tip, link: finger, touch: true}",
                              "bodies: [{name: load, box: [0.1, 0.03, 0.03], mass: 0.3, "
                              "position: [0.05, 0, 0.826]}]\n");
  for (int i = 0; i < 800; ++i) sim->step();
  const Wrench wrist = sim->instruments()[0]->exact(), tip = sim->instruments()[1]->exact();
  EXPECT_NEAR(tip[2], -0.3 * 9.81, 0.05);
  EXPECT_NEAR(tip[4], 0.05 * 0.3 * 9.81, 0.01);  // 50 mm along X
  EXPECT_NEAR(wrist[0], (0.7 + 0.3) * 9.81, 0.05);
}

TEST_F(WrenchTest, MotionTakesItsPart) {
  const auto sim = simulation("{name: wrist, link: hand}");
  Vec3 before = Vec3::Zero(), velocity = Vec3::Zero();
  const auto com = [&] {
    Vec3 sum = Vec3::Zero();
    const auto& description = sim->robot()->description();
    for (const char* name : {"hand", "finger"}) {
      const int link = description.link(name);
      const auto& mass = description.links[static_cast<std::size_t>(link)].inertial;
      sum += mass.mass * (sim->robot()->link_pose(link) * mass.com_L);
    }
    return Vec3(sum / 0.7);
  };
  before = com();
  sim->robot()->go_to(Eigen::VectorXd::Constant(1, 0.1));
  for (int i = 0; i < 200; ++i) {
    sim->step();
    const Vec3 now = com(), next = (now - before) / 0.001;
    const Vec3 acceleration = (next - velocity) / 0.001;
    before = now, velocity = next;
    if (i < 2) continue;
    const Vec3 expected = 0.7 * (Vec3(0, 0, -9.81) - acceleration);
    const int hand = sim->robot()->description().link("hand");
    const Vec3 felt =
        sim->robot()->link_pose(hand).rotation * Vec3(sim->instruments()[0]->exact().head<3>());
    EXPECT_LT((felt - expected).norm(), 1e-6 * (1.0 + expected.norm())) << i;
  }
}

TEST_F(WrenchTest, NoiseIsTheSameForASeedAndAsLargeAsItSays) {
  const std::string noisy =
      "{name: wrist, link: hand, rate: 1000, noise: {force_std: 0.1, force_bias: 1, latency: "
      "0.01}}";
  const auto one = simulation(noisy), other = simulation(noisy);
  double sum = 0.0, squares = 0.0;
  constexpr int count = 800;
  for (int i = 0; i < count; ++i) {
    one->step(), other->step();
    EXPECT_EQ(one->instruments()[0]->reading(), other->instruments()[0]->reading());
    const double error = one->instruments()[0]->reading()[1] - one->instruments()[0]->exact()[1];
    if (i < 100) continue;
    sum += error, squares += error * error;
  }
  const double mean = sum / (count - 100);
  EXPECT_NEAR(std::sqrt(squares / (count - 100) - mean * mean), 0.1, 0.015);
  EXPECT_GT(std::abs(mean), 0.02) << "the bias";
  EXPECT_EQ(one->instruments()[0]->samples(), count);
}

TEST_F(WrenchTest, ATaredSensorBeginsAtZero) {
  const auto sim = simulation("{name: wrist, link: hand, tared: true, rate: 100}");
  for (int i = 0; i < 400; ++i) sim->step();
  EXPECT_LT(sim->instruments()[0]->reading().norm(), 1e-3);
  EXPECT_EQ(sim->instruments()[0]->samples(), 40);
}

TEST_F(WrenchTest, ATaredSensorIsLessTheMeanOfAllOfItsFirstSamples) {
  const auto sim = simulation(
      "{name: wrist, link: hand, tared: true, rate: 100, noise: {force_std: 1}}, "
      "{name: raw, link: hand, rate: 100, noise: {force_std: 1}}");
  std::vector<simulation::Instrument::Sample> tared;
  for (int i = 0; i < 400; ++i) {
    sim->step();
    const auto& fresh = sim->instruments()[0]->new_samples();
    if (sim->world().time() < 0.2 - 1e-6) {
      EXPECT_TRUE(fresh.empty()) << sim->world().time();
      EXPECT_EQ(sim->instruments()[0]->reading().norm(), 0.0);
    }
    tared.insert(tared.end(), fresh.begin(), fresh.end());
  }
  ASSERT_EQ(tared.size(), 40U);
  Wrench sum = Wrench::Zero();
  double smallest = 1e9, before = -1.0;
  for (const auto& one : tared) {
    EXPECT_GT(one.time, before);
    before = one.time;
    if (one.time > 0.2 + 1e-9) continue;
    sum += one.value;
    smallest = std::min(smallest, one.value.head<3>().norm());
  }
  EXPECT_LT(sum.norm(), 1e-9) << "no weight is left, and no row has a mean of its own";
  EXPECT_GT(smallest, 1e-3) << "the first row is no zero";
}

TEST_F(WrenchTest, NamesThatMakeOneFileNameAreTwoFiles) {
  const auto sim = simulation("{name: a/b, link: hand}, {name: a_b, link: finger, touch: true}");
  io::OutputFolder output(folder_ / "out", {});
  SensorRecorder recorder(*sim, output, nullptr);
  for (int i = 0; i < 100; ++i) sim->step(), recorder.record();
  const std::string first = io::read_file(folder_ / "out/wrench_a_b.csv");
  const std::string second = io::read_file(folder_ / "out/wrench_a_b_2.csv");
  EXPECT_EQ(std::ranges::count(first, '\n'), 11);
  EXPECT_EQ(std::ranges::count(second, '\n'), 11);
  EXPECT_NE(first, second);
}

TEST_F(WrenchTest, AnUnknownLinkIsNamed) {
  try {
    simulation("{name: wrist, link: elbow}");
    FAIL();
  } catch (const InvalidFile& fault) {
    EXPECT_NE(std::string(fault.what()).find("no link \"elbow\""), std::string::npos)
        << fault.what();
  }
}

}  // namespace
}  // namespace pedicel::app
