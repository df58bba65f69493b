#include "engine/robot/kinematics.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gtest/gtest.h>

#include "engine/robot/bullet_types.h"
#include "tests/unit/robot/robot_cases.h"

namespace pedicel::robot {
namespace {

using Eigen::VectorXd;
using testing::parse;
using testing::pi;

/// Two links of 0.3 and 0.2 m that turn about z, then a slide along the second link and a mimic.
const char* const planar = R"(
<robot name="planar">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="rod"/><link name="tip"/>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="slide" type="prismatic"><parent link="lower"/><child link="rod"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="1" effort="1" velocity="1"/>
    <mimic joint="elbow" multiplier="0.1" offset="0.2"/></joint>
  <joint name="end" type="fixed"><parent link="rod"/><child link="tip"/>
    <origin xyz="0 0 0.05"/></joint>
</robot>)";

TEST(Kinematics, PlanarArmByHand) {
  const KinematicModel model(parse(planar), {Vec3(1, 0, 0), Quat::Identity()});
  ASSERT_EQ(model.joint_names(), (std::vector<std::string>{"shoulder", "elbow"}));
  const double a = 0.7, b = -0.4;
  const Pose tip = model.link_pose(VectorXd{{a, b}}, model.link_index("tip"));
  const double reach = 0.2 + 0.1 * b;
  const Vec3 expected(1 + 0.3 * std::cos(a) + reach * std::cos(a + b),
                      0.3 * std::sin(a) + reach * std::sin(a + b), 0.05);
  EXPECT_NEAR((tip.position - expected).norm(), 0.0, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(tip.rotation).angle(), a + b, 1e-12);
}

TEST(Kinematics, KnowsWhichJointsMoveALinkAndItsLimits) {
  const KinematicModel model(load_urdf(testing::asset("stalk6")));
  EXPECT_EQ(model.dofs(), 7);
  EXPECT_EQ(model.joint_index("joint3"), 2);
  EXPECT_EQ(model.joint_index("finger_joint_mirror"), -1);
  EXPECT_EQ(model.link_index("no such link"), -1);
  EXPECT_TRUE(model.moves(5, model.link_index("tool")));
  EXPECT_FALSE(model.moves(6, model.link_index("tool")));
  EXPECT_TRUE(model.moves(6, model.link_index("right_finger")));
  const VectorXd far = VectorXd::Constant(7, 100.0);
  EXPECT_EQ(model.clamped(far)[4], 2.1642);
  EXPECT_EQ(model.neutral()[0], 0.0);
}

class RobotFamily : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Kinematics, RobotFamily, ::testing::Values("stalk6", "gantry_gripper"));

TEST_P(RobotFamily, JacobianIsTheDerivativeOfThePose) {
  const KinematicModel model(load_urdf(testing::asset(GetParam())));
  Random random(11);
  const double h = 1e-6;
  const Vec3 point(0.02, -0.03, 0.05);
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = testing::random_positions(model, random);
    const int link = random.integer(0, model.links() - 1);
    const Jacobian j = model.jacobian(q, link, point);
    for (int i = 0; i < model.dofs(); ++i) {
      VectorXd low = q, high = q;
      low[i] -= h;
      high[i] += h;
      const Pose a = model.link_pose(low, link), b = model.link_pose(high, link);
      const Vec3 linear = (b * point - a * point) / (2 * h);
      const Eigen::AngleAxisd turn(b.rotation * a.rotation.conjugate());
      const Vec3 angular = turn.angle() * turn.axis() / (2 * h);
      EXPECT_NEAR((j.col(i).head<3>() - linear).norm(), 0.0, 1e-8);
      EXPECT_NEAR((j.col(i).tail<3>() - angular).norm(), 0.0, 1e-7);
    }
  }
}

TEST_P(RobotFamily, VelocitiesAreTheJacobianTimesTheRates) {
  const KinematicModel model(load_urdf(testing::asset(GetParam())));
  Random random(12);
  const VectorXd q = testing::random_positions(model, random);
  const VectorXd qd = testing::random_positions(model, random);
  std::vector<Pose> poses;
  std::vector<Twist> twists;
  model.link_poses(q, poses);
  model.link_velocities(poses, qd, twists);
  for (int link = 0; link < model.links(); ++link) {
    const Eigen::Matrix<double, 6, 1> twist = model.jacobian(q, link) * qd;
    EXPECT_NEAR((twist.head<3>() - twists[link].linear).norm(), 0.0, 1e-12);
    EXPECT_NEAR((twist.tail<3>() - twists[link].angular).norm(), 0.0, 1e-12);
  }
}

// Bullet's own forward kinematics of the merged bodies: the centre of mass of the link that each
// joint carries, and its velocity, must be where the description puts them.
TEST_P(RobotFamily, AgreesWithBullet) {
  RobotDescription description = load_urdf(testing::asset(GetParam()));
  testing::World world;
  RobotSettings settings;
  settings.base_pose = {Vec3(0.3, -0.2, 0.1),
                        Quat(Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()))};
  Robot robot(description, settings, world.world);
  Random random(13);
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = testing::random_positions(robot.model(), random);
    robot.reset(q, testing::random_positions(robot.model(), random));
    btMultiBody& body = robot.multibody();
    std::vector<btVector3> omega(body.getNumLinks() + 1), velocity(body.getNumLinks() + 1);
    body.compTreeLinkVelocities(omega.data(), velocity.data());
    for (int k = 0; k < body.getNumLinks(); ++k) {
      const int link = body.getLinkCollider(k)->getUserIndex();
      const btTransform& X_WC = body.getLink(k).m_cachedWorldTransform;
      if (description.links[link].name == "gripper" || description.links[link].name == "flange" ||
          description.links[link].name == "turn_head")
        continue;  // merged with the gripper: its centre of mass is not the link's own
      const Vec3 com = robot.link_pose_W(link) * description.links[link].inertial.com_L;
      EXPECT_NEAR((com - from_bullet(X_WC.getOrigin())).norm(), 0.0, 1e-12);
      const btMatrix3x3 R_WC(X_WC.getRotation());
      const Vec3 own = from_bullet(R_WC * omega[k + 1]);
      EXPECT_NEAR((own - robot.link_twist_W(link).angular).norm(), 0.0, 1e-9);
      const Vec3 com_velocity =
          robot.link_twist_W(link).linear +
          own.cross(robot.link_pose_W(link).rotation * description.links[link].inertial.com_L);
      EXPECT_NEAR((com_velocity - from_bullet(R_WC * velocity[k + 1])).norm(), 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace pedicel::robot
