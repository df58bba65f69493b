#include "plugins/discrepancy/scene/giving_joints.h"

#include <gtest/gtest.h>

#include <numbers>

#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {
namespace {

class GivingArmAtStem : public testing::Test {
 protected:
  GivingArmAtStem() { at_.write_all(); }
  ArmAtStem at_;
};

TEST_F(GivingArmAtStem, SwingsAsItsInertiaSaysAndComesToRestAtTorqueOverStiffness) {
  const Experiment experiment = at_.read();
  SceneState state = nominal_state(experiment);
  state.joint_stiffness = 20.0;
  state.joint_damping_time = 0.004;
  const Arm arm(experiment, state);
  constexpr double dt = 1.0e-3, torque = 0.5;
  GivingJoints joints(arm, state, dt);
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(1), effort = Eigen::VectorXd::Constant(1, torque);
  const double rest = torque / state.joint_stiffness;
  std::vector<double> crossings;  // upwards, s
  double before = 0.0;
  for (int k = 1; k <= 4000; ++k) {
    joints.begin_step(q);
    joints.end_step(effort);
    const double now = joints.deflection()[0];
    if (before < rest && now >= rest) crossings.push_back(k * dt);
    before = now;
  }
  EXPECT_NEAR(before, rest, 1.0e-4);
  // Arm and finger about the joint's axis, kg m2.
  const double inertia = 0.004 + 0.3 * 0.2 * 0.2 + 0.000002 + 0.05 * 0.4 * 0.4;
  const double turn = std::sqrt(state.joint_stiffness / inertia);
  const double damping = 0.5 * state.joint_damping_time * turn;
  const double period = 2.0 * std::numbers::pi / (turn * std::sqrt(1.0 - damping * damping));
  ASSERT_GE(crossings.size(), 4u);
  EXPECT_NEAR((crossings[3] - crossings[0]) / 3.0, period, 0.01 * period);
}

TEST_F(GivingArmAtStem, RigidJointsDoNotMove) {
  const Experiment experiment = at_.read();
  const SceneState state = nominal_state(experiment);
  const Arm arm(experiment, state);
  GivingJoints joints(arm, state, 1.0e-3);
  joints.begin_step(Eigen::VectorXd::Zero(1));
  joints.end_step(Eigen::VectorXd::Constant(1, 5.0));
  EXPECT_FALSE(joints.give());
  EXPECT_EQ(joints.deflection()[0], 0.0);
}

TEST_F(GivingArmAtStem, SamplesCountLessWherePredictionsPart) {
  Experiment experiment = at_.read();
  const SceneReadings told = readings_of(experiment);
  Trial& trial = experiment.trials.front();
  trial.markers.value = told.markers;
  SceneDataSet data(experiment);
  SceneReadings off = told, other = told;
  // Off by 4 deviations all the time; predictions part by as much in the second half.
  off.markers.array() += 4.0 * data.deviation(SceneChannel::position);
  const long half = told.markers.rows() / 2;
  other.markers.bottomRows(half).array() += 4.0 * data.deviation(SceneChannel::position);
  const double before = data.sums(0, off)[0].square;
  data.widen(0, told, {&other, 1});
  const double after = data.sums(0, off)[0].square;
  // 16 stays in the first half and becomes 16 / 17 in the second.
  EXPECT_NEAR(after / before, 0.5 * (1.0 + 1.0 / 17.0), 0.03);
  // A second reason adds to the first one.
  data.widen(0, told, {&other, 1}, {&other, 1});
  EXPECT_NEAR(data.sums(0, off)[0].square / before, 0.5 * (1.0 + 1.0 / 33.0), 0.03);
}

}  // namespace
}  // namespace pedicel::discrepancy
