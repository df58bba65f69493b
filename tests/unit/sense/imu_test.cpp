// Accelerometers and gyroscopes of a scene, against what mechanics says of their motion.
#include <gtest/gtest.h>

#include <cmath>

#include "app/report/sensor_recorder.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/sensor_messages.h"
#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"
#include "plugins/simulation/channels.h"
#include "plugins/simulation/instrument.h"
#include "plugins/simulation/simulation.h"
#include "tests/support/stem_plants.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {
namespace {

using Reading = Eigen::Matrix<double, 6, 1>;

constexpr double g = 9.81;  // m/s2

/// An arm that turns about the vertical.
const char* const turntable = R"(<robot name="turntable">
  <link name="base"/>
  <link name="arm"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 1"/><limit effort="1000" velocity="10"/></joint>
</robot>)";

class ImuTest : public testing::Test {
 protected:
  std::unique_ptr<simulation::Simulation> simulation(const std::string& imus,
                                                     const std::string& more = "") {
    io::write_file_atomically(folder_ / "arm.urdf", turntable);
    io::write_file_atomically(folder_ / "path.csv", "time_s,turn\n0,0\n2,4\n");
    io::write_file_atomically(folder_ / "tree.plant.yaml",
                              straight_stem_text +
                                  "fruits: [{name: fruit, curve: stem, at: 1, radius: 0.01, "
                                  "density: 900, detach: {stretch: 0.2}}]\n");
    Diagnostics diagnostics;
    const auto scene = world::parse_scene(
        "format: pedicel-scene\nversion: 1\npurpose: t\nsee: n\nduration: 1\ndt: 0.001\nseed: 2\n"
        "plants: [{name: tree, file: tree.plant.yaml, position: [1, 0, 0]}]\nimus: [" +
            imus + "]\n" + more,
        folder_ / "t.scene.yaml", diagnostics);
    if (!scene) throw InvalidFile(diagnostics);
    return std::make_unique<simulation::Simulation>(*scene, simulation::SimulationOptions{});
  }
  TemporaryFolder folder_;
};

Reading six(const Vec3& acceleration, const Vec3& rate) {
  return (Reading() << acceleration, rate).finished();
}

TEST_F(ImuTest, AtRestItFeelsWhatCarriesIt) {
  // A quarter turn about Y: its X points down, its Z along the world's X.
  const auto sim = simulation(
      "{name: foot, link: base, orientation: [0, 0.7071067811865476, 0, 0.7071067811865476]}, "
      "{name: stem, organ: tree/stem, at: 0.5}",
      "robot: {file: arm.urdf}\n");
  for (int i = 0; i < 100; ++i) sim->step();
  const Reading foot = sim->instruments()[0]->exact(), stem = sim->instruments()[1]->exact();
  EXPECT_LT((foot - six({-g, 0, 0}, {0, 0, 0})).norm(), 1e-9) << foot.transpose();
  EXPECT_LT((stem - six({0, 0, g}, {0, 0, 0})).norm(), 1e-5) << stem.transpose();
}

TEST_F(ImuTest, OnATurningLinkItFeelsThePullToTheMiddle) {
  const auto sim = simulation("{name: tip, link: arm, position: [0.3, 0, 0]}",
                              "robot: {file: arm.urdf, trajectory: path.csv}\n");
  // The middle one of the last three steps is at 1 s, in the middle of a cubic from rest to rest:
  // it turns at w = 3 rad/s there, at a rate that does not change.
  for (int i = 0; i < 1001; ++i) sim->step();
  const Reading felt = sim->instruments()[0]->exact();
  EXPECT_LT((felt - six({-3.0 * 3.0 * 0.3, 0, g}, {0, 0, 3.0})).norm(), 1e-4) << felt.transpose();
}

TEST_F(ImuTest, InFreeFallItFeelsNothing) {
  const auto sim = simulation(
      "{name: cut, organ: tree/stem, at: 0.8}, {name: fruit, organ: tree/fruit}, "
      "{name: stump, organ: tree/stem, at: 0.2}",
      "cuts: [{organ: tree/stem, at: 0.5, time: 0.05}]\n");
  for (int i = 0; i < 120; ++i) {
    sim->step();
    for (const auto& one : sim->instruments()) EXPECT_LT(one->exact().norm(), 20.0) << i;
  }
  EXPECT_LT(sim->instruments()[0]->exact().norm(), 0.1);
  EXPECT_LT(sim->instruments()[1]->exact().norm(), 0.1);
  EXPECT_GT(sim->instruments()[2]->exact().head<3>().norm(), 5.0);
}

TEST_F(ImuTest, AFruitThatCameOffTakesItAlong) {
  const auto sim = simulation("{name: fruit, organ: tree/fruit}",
                              "loads: [{fruit: tree/fruit, force: [0, 0, 2000], to: 0.01}]\n");
  int steps = 0;
  while (sim->plant_step().detached().empty() && ++steps < 100) sim->step();
  ASSERT_LT(steps, 100);
  for (int i = 0; i < 10; ++i) sim->step();
  EXPECT_LT(sim->instruments()[0]->exact().norm(), 0.1);
}

TEST_F(ImuTest, NoiseIsAsLargeAsItSays) {
  const auto sim = simulation(
      "{name: foot, link: base, rate: 1000, noise: {acceleration_std: 0.1, rate_std: 0.02, "
      "rate_bias: 1}}",
      "robot: {file: arm.urdf}\n");
  Reading sum = Reading::Zero(), squares = Reading::Zero();
  constexpr int count = 1000;
  for (int i = 0; i < count; ++i) {
    sim->step();
    const Reading error = sim->instruments()[0]->reading() - sim->instruments()[0]->exact();
    sum += error, squares += error.cwiseAbs2();
  }
  const Reading mean = sum / count;
  for (int i = 0; i < 6; ++i) {
    const double size = i < 3 ? 0.1 : 0.02;
    EXPECT_NEAR(std::sqrt(squares[i] / count - mean[i] * mean[i]), size, 0.1 * size) << i;
  }
  EXPECT_LT(mean.head<3>().norm(), 0.02);
  EXPECT_GT(mean.tail<3>().norm(), 0.1) << "the bias";
}

TEST_F(ImuTest, ItIsInTablesColumnsAndMessages) {
  const auto sim = simulation(
      "{name: foot, link: base, rate: 100, noise: {acceleration_std: 0.5}}, "
      "{name: stem, organ: tree/stem}",
      "robot: {file: arm.urdf}\n");
  io::OutputFolder output(folder_ / "out", {});
  SensorRecorder recorder(*sim, output, nullptr);
  for (int i = 0; i < 100; ++i) sim->step(), recorder.record();
  const std::string table = io::read_file(folder_ / "out/imu_foot.csv");
  EXPECT_TRUE(table.starts_with("time,ax,ay,az,wx,wy,wz\n")) << table;
  EXPECT_EQ(std::ranges::count(table, '\n'), 11);
  const auto columns = simulation::channels_of(*sim);
  const auto az = std::ranges::find(columns, "imu_stem_az_m/s2", &simulation::Channel::name);
  ASSERT_NE(az, columns.end());
  EXPECT_NEAR(az->read(), g, 1e-3);
  const auto message = ros::from_cdr<ros::Imu>(sim->instruments()[0]->message());
  ASSERT_TRUE(message);
  EXPECT_EQ(message->header.frame_id, "foot/imu");
  EXPECT_NEAR(ros::seconds_of(message->header.stamp), 0.1, 1e-9);
  EXPECT_EQ(message->linear_acceleration.z, sim->instruments()[0]->reading()[2]);
  EXPECT_EQ(message->linear_acceleration_covariance[4], 0.25);
  EXPECT_EQ(message->orientation_covariance[0], -1.0) << "it says no orientation";
}

TEST_F(ImuTest, ItsKeysAreWrittenAsRead) {
  const auto sim = simulation(
      "{name: foot, link: base, position: [0, 0.1, 0]}, "
      "{name: stem, organ: tree/stem, at: 0.25, noise: {rate_walk: 0.001}}",
      "robot: {file: arm.urdf}\n");
  const std::string text = world::scene_text(sim->scene(), folder_ / "");
  EXPECT_NE(text.find("  - {name: foot, link: base, position: [0, 0.1, 0]}\n"), text.npos) << text;
  EXPECT_NE(text.find("  - {name: stem, organ: tree/stem, at: 0.25, noise: {rate_walk: 0.001}}\n"),
            text.npos)
      << text;
}

TEST_F(ImuTest, ASeatThatIsNotThereIsNamed) {
  const auto fault_of = [&](const std::string& imu) -> std::string {
    try {
      simulation(imu, "robot: {file: arm.urdf}\n");
    } catch (const InvalidFile& fault) {
      return fault.what();
    }
    return "";
  };
  const auto expect = [&](const std::string& imu, const std::string& words) {
    const std::string fault = fault_of("{name: i, " + imu + "}");
    EXPECT_NE(fault.find(words), fault.npos) << fault;
  };
  expect("link: elbow", "imu \"i\": the robot has no link \"elbow\"");
  expect("organ: tree/twig", "no organ \"tree/twig\"");
  expect("organ: bush/stem", "organ \"bush/stem\"");
  expect("rate: 10", "an IMU: expected link or organ");
  expect("link: arm, organ: tree/stem", "an IMU: expected link or organ");
}

}  // namespace
}  // namespace pedicel::app
