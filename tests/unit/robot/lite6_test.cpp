#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pedicel/robot/cartesian_path.h"
#include "unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;
using testing::World;

constexpr double dt = 1.0 / 240.0;

/// The maker's own file, meshes and all.
class Lite6 : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(testing::lite6_path())) GTEST_SKIP() << "no lite6 data";
    description_ = read_urdf(testing::lite6_path(), {}, diagnostics_);
    ASSERT_TRUE(description_) << diagnostics_.text();
  }

  Diagnostics diagnostics_;
  std::optional<RobotDescription> description_;
};

TEST_F(Lite6, LoadsAndSaysThatTheBaseHasNoInertia) {
  ASSERT_EQ(diagnostics_.all().size(), 1u) << diagnostics_.text();
  EXPECT_THAT(diagnostics_.text(),
              ::testing::HasSubstr("warning: link 'link_base': no usable inertia"));
  const KinematicModel model(*description_);
  EXPECT_EQ(model.dofs(), 6);
  EXPECT_GE(model.link_index("link_eef"), 0);
  EXPECT_GT(
      description_->links[description_->link("link3")].visuals[0].geometry.mesh->triangles.size(),
      1000u);
}

TEST_F(Lite6, Stands) {
  World world;
  Robot robot(*description_, {}, world.world);
  VectorXd q(6);
  q << 0.3, -0.4, 1.1, 0.2, 0.9, -0.5;
  robot.reset(q, VectorXd::Zero(6));
  for (int step = 0; step < 1200; ++step) world.step(robot, dt);
  EXPECT_LT((robot.positions() - q).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(robot.velocities().cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(Lite6, MovesThroughWaypoints) {
  World world;
  Robot robot(*description_, {}, world.world);
  const KinematicModel& model = robot.model();
  std::vector<Waypoint> waypoints(2);
  for (int i = 0; i < 2; ++i) {
    waypoints[i].time = 2.0 + i;
    waypoints[i].tool = "link_eef";
    waypoints[i].position_W = Vec3(0.25, 0.05 * i, 0.2);
    waypoints[i].approach_W = -Vec3::UnitZ();
  }
  Diagnostics faults;
  const Trajectory trajectory = plan_cartesian(model, waypoints, model.neutral(), {}, faults);
  ASSERT_FALSE(trajectory.empty()) << faults.text();
  VectorXd q, qd;
  double worst = 0.0;
  for (int step = 1; step <= 840; ++step) {
    trajectory.sample(step * dt, q, qd);
    robot.set_position_targets(q, qd);
    world.step(robot, dt);
    worst = std::max(worst, (robot.positions() - q).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_NEAR((robot.link_pose_W("link_eef").position - Vec3(0.25, 0.05, 0.2)).norm(), 0.0, 1e-4);
}

}  // namespace
}  // namespace pedicel::robot
