#include "engine/robot/trajectory.h"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/core/check.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;

VectorXd one(double value) {
  return VectorXd::Constant(1, value);
}

TEST(Trajectory, PassesThroughItsRowsAndRestsOutside) {
  const Trajectory trajectory({1, 2, 4}, {one(0), one(1), one(3)});
  EXPECT_EQ(trajectory.duration(), 4.0);
  VectorXd q, qd;
  for (const auto& [time, value] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}, {9.0, 3.0}}) {
    trajectory.sample(time, q, qd);
    EXPECT_NEAR(q[0], value, 1e-14);
  }
  EXPECT_EQ(qd[0], 0.0);
}

TEST(Trajectory, VelocityIsTheDerivativeAndNothingOvershoots) {
  Random random(31);
  std::vector<double> times;
  std::vector<VectorXd> rows;
  for (int i = 0; i < 20; ++i) {
    times.push_back(i + random.uniform(0.0, 0.5));
    rows.push_back(one(i % 4 == 3 ? rows.back()[0] : random.uniform(-1.0, 1.0)));
  }
  const Trajectory trajectory(times, rows);
  VectorXd q, qd, before, after, unused;
  const double h = 1e-6;
  for (int i = 0; i + 1 < 20; ++i) {
    for (double s = 0.05; s < 1.0; s += 0.1) {
      const double t = times[i] + s * (times[i + 1] - times[i]);
      trajectory.sample(t, q, qd);
      trajectory.sample(t - h, before, unused);
      trajectory.sample(t + h, after, unused);
      EXPECT_NEAR(qd[0], (after[0] - before[0]) / (2 * h), 1e-7);
      EXPECT_GE(q[0], std::min(rows[i][0], rows[i + 1][0]) - 1e-12);
      EXPECT_LE(q[0], std::max(rows[i][0], rows[i + 1][0]) + 1e-12);
    }
  }
}

TEST(Trajectory, RefusesRowsThatDoNotFit) {
  EXPECT_THROW(Trajectory({}, {}), UsageError);
  EXPECT_THROW(Trajectory({0, 1}, {one(0)}), UsageError);
  EXPECT_THROW(Trajectory({1, 1}, {one(0), one(0)}), UsageError);
  EXPECT_THROW(Trajectory({0, 1}, {one(0), VectorXd::Zero(2)}), UsageError);
}

TEST(Trajectory, ReadsACsvAndLeavesOtherJointsAtTheStart) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "trajectory_test.csv";
  std::ofstream(path) << "# by hand\ntime_s,joint3,joint1\n0,0.5,0\n1,0.7,-0.2\n";
  const RobotDescription robot = load_urdf(testing::asset("stalk6"));
  const KinematicModel model(robot);
  VectorXd start = model.neutral();
  start[6] = 0.01;
  Diagnostics diagnostics;
  const Trajectory trajectory = read_trajectory_csv(path, robot, model, start, diagnostics);
  ASSERT_FALSE(trajectory.empty()) << diagnostics.text();
  VectorXd q, qd;
  trajectory.sample(1.0, q, qd);
  EXPECT_EQ(q[0], -0.2);
  EXPECT_EQ(q[2], 0.7);
  EXPECT_EQ(q[6], 0.01);
  std::filesystem::remove(path);
}

// As a spreadsheet writes it, in ms and degrees.
TEST(Trajectory, ReadsOtherWaysOfWritingIt) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "other_trajectory.csv";
  std::ofstream(path) << "\xEF\xBB\xBFTime (ms);JOINT3;joint1 (deg)\r\n0;0,5;0\r\n1000;0,7;-90\r\n";
  const RobotDescription robot = load_urdf(testing::asset("stalk6"));
  const KinematicModel model(robot);
  Diagnostics diagnostics;
  const Trajectory trajectory =
      read_trajectory_csv(path, robot, model, model.neutral(), diagnostics);
  ASSERT_FALSE(trajectory.empty()) << diagnostics.text();
  EXPECT_DOUBLE_EQ(trajectory.times()[1], 1.0);
  EXPECT_DOUBLE_EQ(trajectory.positions()[1][2], 0.7);
  EXPECT_NEAR(trajectory.positions()[1][0], -1.5707963267948966, 1e-12);
  std::filesystem::remove(path);
}

TEST(Trajectory, WrittenAsATableItIsTheSame) {
  const RobotDescription robot = load_urdf(testing::asset("stalk6"));
  const KinematicModel model(robot);
  Random random(7);
  std::vector<double> times;
  std::vector<VectorXd> rows;
  for (int i = 0; i < 5; ++i) {
    times.push_back(i + random.uniform());
    rows.push_back(testing::random_positions(model, random));
  }
  const auto path = std::filesystem::path(::testing::TempDir()) / "written.csv";
  std::ofstream(path) << trajectory_csv(Trajectory(times, rows), model);
  Diagnostics diagnostics;
  const Trajectory read = read_trajectory_csv(path, robot, model, model.neutral(), diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << diagnostics.text();
  EXPECT_EQ(read.times(), times);
  ASSERT_EQ(read.positions().size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(read.positions()[i], rows[i]);
}

}  // namespace
}  // namespace pedicel::robot
