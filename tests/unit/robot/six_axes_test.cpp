#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/robot/cartesian_path.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;
using testing::World;

constexpr double dt = 1.0 / 240.0;

struct Arm {
  std::string name;
  std::filesystem::path urdf;
  std::string tool;
};

/// Our own arm and, where it lies beside the tree, the maker's whose sizes ours has.
std::vector<Arm> arms() {
  std::vector<Arm> found = {{"stalk6", testing::asset("stalk6"), "tool"}};
  if (std::filesystem::exists(testing::lite6_path()))
    found.push_back({"lite6", testing::lite6_path(), "link_eef"});
  return found;
}

class SixAxes : public ::testing::TestWithParam<Arm> {};
INSTANTIATE_TEST_SUITE_P(All, SixAxes, ::testing::ValuesIn(arms()),
                         [](const auto& arm) { return arm.param.name; });

// The maker's own file, meshes and all.
TEST(Lite6, LoadsAndSaysThatTheBaseHasNoInertia) {
  if (!std::filesystem::exists(testing::lite6_path())) GTEST_SKIP() << "no lite6 data";
  Diagnostics diagnostics;
  const auto description = read_urdf(testing::lite6_path(), {}, diagnostics);
  ASSERT_TRUE(description) << diagnostics.text();
  ASSERT_EQ(diagnostics.all().size(), 1u) << diagnostics.text();
  EXPECT_THAT(diagnostics.text(),
              ::testing::HasSubstr("warning: link 'link_base': no usable inertia"));
  const KinematicModel model(*description);
  EXPECT_EQ(model.dofs(), 6);
  EXPECT_GE(model.link_index("link_eef"), 0);
  EXPECT_GT(
      description->links[description->link("link3")].visuals[0].geometry.mesh->triangles.size(),
      1000u);
}

TEST_P(SixAxes, Stand) {
  World world;
  Robot robot(load_urdf(GetParam().urdf), {}, world.world);
  VectorXd q = robot.model().neutral();
  q.head<6>() << 0.3, -0.4, 1.1, 0.2, 0.9, -0.5;
  robot.reset(q, VectorXd::Zero(q.size()));
  for (int step = 0; step < 1200; ++step) world.step(robot, dt);
  EXPECT_LT((robot.positions() - q).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(robot.velocities().cwiseAbs().maxCoeff(), 1e-6);
}

TEST_P(SixAxes, MoveThroughWaypoints) {
  World world;
  Robot robot(load_urdf(GetParam().urdf), {}, world.world);
  const KinematicModel& model = robot.model();
  std::vector<Waypoint> waypoints(2);
  for (int i = 0; i < 2; ++i) {
    waypoints[i].time = 2.0 + i;
    waypoints[i].tool = GetParam().tool;
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
    robot.motors().set_position_targets(q, qd);
    world.step(robot, dt);
    worst = std::max(worst, (robot.positions() - q).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_NEAR(
      (robot.link_pose_W(robot.link(GetParam().tool)).position - Vec3(0.25, 0.05, 0.2)).norm(), 0.0,
      1e-4);
}

}  // namespace
}  // namespace pedicel::robot
