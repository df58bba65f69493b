// Each effect of a scene against what mechanics or optics say of it.

#include <gmock/gmock.h>

#include "plugins/cosserat/solver/standing.h"
#include "plugins/discrepancy/scene/camera.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {
namespace {

constexpr double g = 9.81;
constexpr int tip = 0, middle = 3, nail = 6;  // columns of the markers

class SceneEffects : public testing::Test {
 protected:
  // Far from the stem: nothing is touched.
  Experiment& free() {
    if (!free_) {
      at_.gap = "0.5";
      at_.write_all();
      free_ = at_.read();
    }
    return *free_;
  }
  // The finger pushes the stem.
  Experiment& pushing() {
    if (!pushing_) {
      at_.write_all();
      pushing_ = at_.read();
    }
    return *pushing_;
  }
  ArmAtStem at_;
  std::optional<Experiment> free_, pushing_;
};

Vec3 point(const Eigen::MatrixXd& rows, long row, int column) {
  return rows.row(row).segment<3>(column).transpose();
}

TEST_F(SceneEffects, PlantPoseMovesAndTurnsThePlantAboutItsRoot) {
  const SceneReadings plain = readings_of(free());
  const SceneReadings moved = readings_of(
      free(), {"{name: plant_pose, offset: [0.01, -0.02, 0.003], yaw: 0.4, plant: bush}"});
  const Vec3 root(ArmAtStem::reach, 0.5, 0);
  const Quat turn(Eigen::AngleAxisd(0.4, Vec3::UnitZ()));
  for (const int column : {tip, middle}) {
    const Vec3 expected =
        root + Vec3(0.01, -0.02, 0.003) + turn * (point(plain.markers, 60, column) - root);
    EXPECT_LT((point(moved.markers, 60, column) - expected).norm(), 1e-7);
  }
  EXPECT_LT((point(moved.markers, 60, nail) - point(plain.markers, 60, nail)).norm(), 1e-12);
}

TEST_F(SceneEffects, JointOffsetTurnsTheArmBeyondItsReadings) {
  const SceneReadings moved =
      readings_of(free(), {"{name: joint_offset, joint: turn, offset: 0.05}"});
  const Vec3 place = point(moved.markers, 0, nail);
  EXPECT_NEAR(place.x(), ArmAtStem::reach * std::cos(0.05), 1e-5);
  EXPECT_NEAR(place.y(), ArmAtStem::reach * std::sin(0.05), 1e-5);
  EXPECT_NEAR(place.z(), 0.4, 1e-9);
}

TEST_F(SceneEffects, RobotLatencyPutsTheLogBehindTheOtherInstruments) {
  const SceneReadings plain = readings_of(free());
  const SceneReadings late = readings_of(free(), {"{name: robot_latency, delay: 0.05}"});
  // A row of the log at t holds what was at t - 0.05 s: what is at 0.45 s stands in it at 0.5 s.
  EXPECT_LT((point(late.markers, 45, nail) - point(plain.markers, 50, nail)).norm(), 1e-6);
}

TEST_F(SceneEffects, ToolPoseMountsTheToolElsewhereInItsCarrier) {
  const SceneReadings moved =
      readings_of(free(), {"{name: tool_pose, offset: [0.01, 0, 0.02], rotation: [0.1, 0, 0]}"});
  const Vec3 expected = Vec3(ArmAtStem::reach + 0.01, 0, 0.32) +
                        Eigen::AngleAxisd(0.1, Vec3::UnitX()) * Vec3(0, 0, 0.1);
  EXPECT_LT((point(moved.markers, 0, nail) - expected).norm(), 1e-5);
}

TEST_F(SceneEffects, TheWrenchIsWeightAndInertiaOfTheLink) {
  const Eigen::MatrixXd wrench = readings_of(free()).wrenches[0];
  EXPECT_NEAR(wrench(0, 2), -0.05 * g, 1e-6);
  // Halfway it swings with 1.875 swing / 0.8 rad/s: outward by m r w^2.
  const double w = 1.875 * at_.swing / 0.8;
  EXPECT_NEAR(wrench(50, 0), 0.05 * ArmAtStem::reach * w * w, 1e-4);
}

TEST_F(SceneEffects, PayloadAddsItsWeightAndMoment) {
  const Eigen::MatrixXd plain = readings_of(free()).wrenches[0];
  const Eigen::MatrixXd loaded =
      readings_of(free(), {"{name: payload, mass: 0.1, centre: [0.03, 0, 0.05]}"}).wrenches[0];
  EXPECT_NEAR(loaded(0, 2) - plain(0, 2), -0.1 * g, 1e-9);
  // r x F with F = (0, 0, -m g).
  EXPECT_NEAR(loaded(0, 4) - plain(0, 4), 0.03 * 0.1 * g, 1e-9);
}

TEST_F(SceneEffects, WrenchBiasAndGainActOnWhatIsMeasured) {
  const Eigen::MatrixXd plain = readings_of(free()).wrenches[0];
  const Eigen::MatrixXd off =
      readings_of(free(), {"{name: wrench_bias, force: [0.1, 0.2, 0.3], moment: [0.01, 0, 0]}",
                           "{name: wrench_gain, gain: 1.1, wrench: wrist}"})
          .wrenches[0];
  Eigen::Matrix<double, 1, 6> bias;
  bias << 0.1, 0.2, 0.3, 0.01, 0, 0;
  EXPECT_LT((off.row(30) - 1.1 * plain.row(30) - bias).norm(), 1e-9);
}

TEST_F(SceneEffects, CamerasSeeByPinholeAndBrown) {
  // The camera looks along +y from (0.4, -1, 0.3): x right is +x, y down is -z.
  const SceneReadings plain = readings_of(free());
  const Vec3 p = point(plain.markers, 0, nail);
  const double x = (p.x() - 0.4) / (p.y() + 1.0), y = -(p.z() - 0.3) / (p.y() + 1.0);
  EXPECT_NEAR(plain.pixels[0](0, 4), 640 + 1000 * x, 1e-3);
  EXPECT_NEAR(plain.pixels[0](0, 5), 360 + 1000 * y, 1e-3);
  const auto seen = [&](const std::string& effect) -> Eigen::Vector2d {
    return readings_of(free(), {effect}).pixels[0].row(0).segment<2>(4).transpose();
  };
  EXPECT_LT(
      (seen("{name: camera_focal, factor: 1.02}") - Eigen::Vector2d(640 + 1020 * x, 360 + 1020 * y))
          .norm(),
      1e-3);
  const double radial = 1.0 + 0.1 * (x * x + y * y);
  EXPECT_LT((seen("{name: lens_distortion, k1: 0.1}") -
             Eigen::Vector2d(640 + 1000 * x * radial, 360 + 1000 * y * radial))
                .norm(),
            1e-3);
  EXPECT_LT((seen("{name: camera_pose, offset: [0.01, 0, 0]}") -
             Eigen::Vector2d(640 + 1000 * (x - 0.01 / (p.y() + 1.0)), 360 + 1000 * y))
                .norm(),
            1e-3);
  // Turned about its own forward axis by a: the picture turns by -a about the centre.
  const double a = 0.02;
  const Eigen::Vector2d turned(std::cos(a) * x + std::sin(a) * y,
                               -std::sin(a) * x + std::cos(a) * y);
  EXPECT_LT((seen("{name: camera_pose, offset: [0, 0, 0], rotation: [0, 0, 0.02]}") -
             (Eigen::Vector2d(640, 360) + 1000 * turned))
                .norm(),
            1e-3);
}

TEST_F(SceneEffects, JointFrictionAddsToTheMotorsTorque) {
  const Eigen::MatrixXd plain = readings_of(free()).torques;
  const Eigen::MatrixXd more =
      readings_of(free(), {"{name: joint_friction, coulomb: 0.4, viscous: 2}"}).torques;
  const double w = 1.875 * at_.swing / 0.8;
  EXPECT_NEAR(more(50, 0) - plain(50, 0), 0.4 + 2.0 * w, 1e-3);
  // Before it moves: what is left of the readings' noise.
  EXPECT_NEAR(more(0, 0) - plain(0, 0), 0.0, 0.05);
}

TEST_F(SceneEffects, APushedStemPushesBackAsABeamDoes) {
  // The stem leans away from the finger, whose lower edge, 0.2 m high, pushes: F = 3 EI d / h^3.
  const SceneReadings readings = readings_of(pushing());
  const long last = readings.wrenches[0].rows() - 1;
  const double height = 0.2;
  const double way = ArmAtStem::reach * std::sin(at_.joint(at_.duration)) - 0.03 + 0.006 + 0.004;
  const double stiffness = 3.0 * 1.0e9 * M_PI / 4.0 * std::pow(0.004, 4) / std::pow(height, 3);
  EXPECT_NEAR(-readings.wrenches[0](last, 1), stiffness * way, 0.15 * stiffness * way);
}

// Where the plant stands is fitted, too, and on the way there its stem may stand in the arm.
TEST_F(SceneEffects, AStemThatStandsInTheArmLeansOnItFromTheStart) {
  // The whole edge of the finger touches at once, 0.2 m above the root and higher.
  const double stiffness = 3.0 * 1.0e9 * M_PI / 4.0 * std::pow(0.004, 4) / std::pow(0.2, 3);
  at_.swing = 0.0;
  // 2 mm within the finger on its one side, 3 mm on its other.
  for (const auto& [gap, way] : {std::pair{"0.008", 0.002}, std::pair{"-0.007", -0.003}}) {
    at_.gap = gap;
    at_.write_all();
    for (const auto& effects :
         {std::vector<std::string>{},
          std::vector<std::string>{"{name: reaction, joint_stiffness: 2000}"}}) {
      const SceneReadings readings = readings_of(at_.read(), effects);
      ASSERT_TRUE(readings.healthy);
      const Eigen::VectorXd push = readings.wrenches[0].col(1);
      EXPECT_NEAR(push[0], -stiffness * way, 0.15 * stiffness * std::abs(way)) << gap;
      // It stands there: nothing is thrown out. Joints that give way do so in the first step.
      const double change = effects.empty() ? 0.05 : 0.12;
      EXPECT_LT((push.array() - push[0]).abs().maxCoeff(), change * std::abs(push[0])) << gap;
    }
  }
}

// What the stem exerts on the finger, less the finger's own weight: in the finger's frame.
Vec3 push_of(const SceneReadings& readings, long row) {
  return readings.wrenches[0].row(row).head<3>().transpose() + Vec3(0, 0, 0.05 * g);
}

TEST_F(SceneEffects, FrictionOfTheContactIsCoulombs) {
  // The finger's lower edge slides along the stem while it pushes. Without friction the force is
  // along the normal.
  const SceneReadings smooth = readings_of(pushing(), {"{name: contact_friction, coefficient: 0}"});
  for (const double mu : {0.1, 0.4}) {
    const SceneReadings rough = readings_of(
        pushing(), {"{name: contact_friction, coefficient: " + std::to_string(mu) + "}"});
    for (long row = 60; row <= 85; row += 5) {
      const Vec3 normal = push_of(smooth, row).normalized(), force = push_of(rough, row);
      const double along = force.dot(normal);
      EXPECT_GT(along, 0.5);
      EXPECT_NEAR((force - along * normal).norm() / along, mu, 0.02 * mu) << row;
    }
  }
}

TEST_F(SceneEffects, ContactFrictionOfOneLinkLeavesTheOthers) {
  SceneState state = nominal_state(pushing());
  apply_scene_effect(scene_effect("{name: contact_friction, factor: 0.5, link: finger}", pushing()),
                     pushing(), state);
  EXPECT_DOUBLE_EQ(state.coupling.friction, 0.5);
  EXPECT_DOUBLE_EQ(state.friction_of_link.at(pushing().robot.link("finger")), 0.25);
}

TEST_F(SceneEffects, ContactComplianceLetsTheToolSinkIn) {
  const SceneReadings stiff = readings_of(pushing());
  const SceneReadings soft =
      readings_of(pushing(), {"{name: contact_compliance, stiffness: 1000}"});
  const long last = stiff.wrenches[0].rows() - 1;
  const auto force = [&](const SceneReadings& r) { return -r.wrenches[0](last, 1); };
  // Springs in series: the whole way is that of the stem and of the contact.
  const double way = ArmAtStem::reach * std::sin(at_.joint(at_.duration)) - 0.02;
  const double stem = force(stiff) / way;
  EXPECT_NEAR(force(soft), way / (1.0 / stem + 1.0 / 1000.0), 0.1 * force(soft));
}

TEST_F(SceneEffects, ReactionTurnsTheJointByTorqueOverStiffness) {
  const double stiffness = 20.0;
  const SceneReadings given = readings_of(pushing(), {"{name: reaction, joint_stiffness: 20}"});
  const long last = given.markers.rows() - 1;
  const Vec3 place = point(given.markers, last, nail);
  const double turned = std::atan2(place.y(), place.x()) - at_.joint(at_.duration);
  // The push on the finger, in the finger's frame: along y it turns the joint, at the reach.
  const Eigen::RowVectorXd wrench = given.wrenches[0].row(given.wrenches[0].rows() - 1);
  const double torque = ArmAtStem::reach * wrench[1] + wrench[5];
  EXPECT_NEAR(turned, torque / stiffness, 0.02 * std::abs(turned));
  EXPECT_LT(turned, -0.002);
  // A rigid arm pushes harder.
  const SceneReadings rigid = readings_of(pushing());
  EXPECT_GT(std::abs(rigid.wrenches[0](given.wrenches[0].rows() - 1, 1)), std::abs(wrench[1]));
}

TEST_F(SceneEffects, ThePayloadsWeightIsTheMotorsToo) {
  // The joint's axis leans by gravity's turn: it carries the payload 0.4 m out.
  Experiment lying = free();
  lying.scene.gravity = {0, -g, 0};
  const SceneReadings plain = readings_of(lying),
                      laden = readings_of(lying, {"{name: payload, mass: 0.1}"});
  EXPECT_NEAR(laden.torques(0, 0) - plain.torques(0, 0), 0.1 * g * ArmAtStem::reach, 1e-3);
}

TEST_F(SceneEffects, WhatIsGraspedGoesWhereTheLinkGoes) {
  at_.swing = 0.005;
  at_.write_all();
  at_.write("push/events.csv",
            "time,event,what,by\n0.05,grasped,stem,finger\n1.05,released,stem,finger\n");
  const Experiment held = at_.read();
  const SceneReadings all = readings_of(held);
  // In the middle of the motion, at 4 mm/s, the link feels the stem's bending and stretch and no
  // more: what held it a step behind would pull with 4 N.
  const Eigen::RowVectorXd wrench = all.wrenches[0].row(50);
  EXPECT_LT(wrench.head<3>().norm(), 0.05 * g + 1.0);
}

TEST_F(SceneEffects, FruitsWeighAndHoldMultiplesOfTheFile) {
  SceneState state = nominal_state(free());
  apply_scene_effect(scene_effect("{name: fruit_mass, factor: 1.5}", free()), free(), state);
  apply_scene_effect(scene_effect("{name: detachment_threshold, factor: 0.7}", free()), free(),
                     state);
  apply_scene_effect(scene_effect("{name: detachment_threshold, factor: 2}", free()), free(),
                     state);
  EXPECT_DOUBLE_EQ(state.plants[0].fruit_mass, 1.5);
  EXPECT_DOUBLE_EQ(state.plants[0].threshold, 1.4);
}

TEST_F(SceneEffects, OfNoSizeLeaveWhatInstrumentsSay) {
  const SceneReadings plain = readings_of(free());
  const SceneReadings same = readings_of(
      free(), {"{name: plant_pose, offset: [0, 0, 0]}", "{name: tool_pose, offset: [0, 0, 0]}",
               "{name: joint_offset, joint: turn, offset: 0}", "{name: wrench_gain, gain: 1}",
               "{name: payload, mass: 0}", "{name: camera_focal, factor: 1}"});
  EXPECT_LT((same.markers - plain.markers).norm(), 1e-12);
  EXPECT_LT((same.wrenches[0] - plain.wrenches[0]).norm(), 1e-12);
  EXPECT_LT((same.pixels[0] - plain.pixels[0]).norm(), 1e-9);
}

TEST(Camera, ADirectionIsSeenWhereItCameFrom) {
  Camera camera;
  camera.focal = {1100, 1050};
  camera.centre = {650, 340};
  camera.distortion = {-0.25, 0.1, 0.002, -0.001, -0.02};
  camera.X_WC = {Vec3(0.2, -1, 0.4), looking_at(Vec3(0.2, -1, 0.4), Vec3(0.1, 0, 0.3))};
  for (const Vec3& point : {Vec3(0.1, 0, 0.3), Vec3(0.5, 0.1, 0.5), Vec3(-0.3, -0.1, 0.1)}) {
    const Vec3 p_C = camera.X_WC.inverse() * point;
    const Eigen::Vector2d direction = direction_of(camera, image_of(camera, point));
    EXPECT_NEAR(direction.x(), p_C.x() / p_C.z(), 1e-8);
    EXPECT_NEAR(direction.y(), p_C.y() / p_C.z(), 1e-8);
  }
  camera.distortion = {-5.0, 0, 0, 0, 0};  // folds the picture over: most places come from nowhere
  EXPECT_TRUE(direction_of(camera, {1280, 720}).hasNaN());
}

}  // namespace
}  // namespace pedicel::discrepancy
