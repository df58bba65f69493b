#include "engine/robot/cartesian_path.h"

#include <gtest/gtest.h>

#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;

Waypoint waypoint(double time, const Vec3& position, std::optional<Vec3> approach = {}) {
  Waypoint result;
  result.time = time;
  result.tool = "tool";
  result.position_W = position;
  result.approach_W = approach;
  return result;
}

class CartesianPath : public ::testing::Test {
 protected:
  Trajectory plan(const std::vector<Waypoint>& waypoints) {
    const Trajectory trajectory = plan_cartesian(model_, waypoints, start(), {}, diagnostics_);
    if (trajectory.empty()) throw InvalidFile(diagnostics_);
    return trajectory;
  }
  VectorXd start() const {
    VectorXd q = model_.neutral();
    q[2] = 1.2;
    return q;
  }
  Pose tool_at(const Trajectory& trajectory, double time) {
    VectorXd q, qd;
    trajectory.sample(time, q, qd);
    return model_.link_pose(q, model_.link_index("tool"));
  }

  KinematicModel model_{load_urdf(testing::asset("stalk6"))};
  Diagnostics diagnostics_;
};

// Half way in time the minimum jerk profile is half way in space: 10/8 - 15/16 + 6/32 = 1/2; at a
// quarter it is 10/64 - 15/256 + 6/1024 = 0.103515625.
TEST_F(CartesianPath, RunsStraightWithMinimumJerk) {
  const Vec3 a(0.25, -0.05, 0.3), b(0.3, 0.1, 0.25), forward(1, 0, 0);
  const Trajectory trajectory = plan({waypoint(2, a, forward), waypoint(4, b, forward)});
  EXPECT_EQ(trajectory.duration(), 4.0);
  EXPECT_NEAR((tool_at(trajectory, 2.0).position - a).norm(), 0.0, 2e-5);
  EXPECT_NEAR((tool_at(trajectory, 2.5).position - (a + 0.103515625 * (b - a))).norm(), 0.0, 1e-4);
  EXPECT_NEAR((tool_at(trajectory, 3.0).position - (a + 0.5 * (b - a))).norm(), 0.0, 5e-5);
  EXPECT_NEAR((tool_at(trajectory, 4.0).position - b).norm(), 0.0, 2e-5);
  for (double t = 2.0; t <= 4.0; t += 0.037)
    EXPECT_NEAR((tool_at(trajectory, t).rotation * Vec3::UnitZ() - forward).norm(), 0.0, 5e-4);
}

TEST_F(CartesianPath, TurnsEvenlyBetweenOrientations) {
  const Quat down(Eigen::AngleAxisd(testing::pi, Vec3::UnitX()));
  const Quat turned(Eigen::AngleAxisd(0.6, Vec3::UnitZ()) * down);
  Waypoint a = waypoint(2, {0.25, 0, 0.2}), b = waypoint(3, {0.25, 0.05, 0.2});
  a.orientation_W = down;
  b.orientation_W = turned;
  const Trajectory trajectory = plan({a, b});
  const Quat middle = tool_at(trajectory, 2.5).rotation;
  EXPECT_NEAR(middle.angularDistance(down), 0.3, 1e-3);
  EXPECT_NEAR(middle.angularDistance(turned), 0.3, 1e-3);
}

TEST_F(CartesianPath, IsContinuousAndKeepsSpeedAndJointLimits) {
  const Trajectory trajectory = plan({waypoint(2, {0.25, 0.1, 0.3}, Vec3(1, 0, 0)),
                                      waypoint(4, {0.3, 0.1, 0.3}, Vec3(1, 0, 0)),
                                      waypoint(6, {0.28, 0.14, 0.22}, Vec3(0.8, 0, -0.6))});
  VectorXd q, qd, previous;
  trajectory.sample(0.0, previous, qd);
  EXPECT_EQ(previous, start());
  for (double t = 1e-3; t < 6.0; t += 1e-3) {
    trajectory.sample(t, q, qd);
    EXPECT_LT((q - previous).cwiseAbs().maxCoeff(), 3.14 * 1.5e-3);
    EXPECT_EQ(q, model_.clamped(q));
    previous = q;
  }
}

TEST_F(CartesianPath, TheGripperFollowsItsOwnValuesAndKeepsThem) {
  Waypoint open = waypoint(2, {0.25, 0, 0.3}), closed = waypoint(3, {0.25, 0, 0.3}),
           away = waypoint(4, {0.25, 0, 0.35});
  open.joints = {{"finger_joint", 0.02}};
  closed.joints = {{"finger_joint", 0.012}};
  const Trajectory trajectory = plan({open, closed, away});
  VectorXd q, qd;
  for (const auto& [time, value] :
       {std::pair{2.0, 0.02}, {2.5, 0.016}, {3.0, 0.012}, {4.0, 0.012}}) {
    trajectory.sample(time, q, qd);
    EXPECT_NEAR(q[6], value, 1e-9) << time;
  }
}

TEST_F(CartesianPath, AFirstWaypointAtTimeZeroIsWhereTheRobotStands) {
  const Trajectory trajectory = plan({waypoint(0, {0.25, 0, 0.3}), waypoint(1, {0.25, 0, 0.32})});
  EXPECT_NEAR((tool_at(trajectory, 0.0).position - Vec3(0.25, 0, 0.3)).norm(), 0.0, 2e-5);
}

}  // namespace
}  // namespace pedicel::robot
