#include "plugins/discrepancy/scene_predict/arm_run.h"

#include <algorithm>
#include <cmath>

#include "engine/robot/robot.h"
#include "engine/robot/trajectory.h"
#include "engine/world/sim_world.h"
#include "plugins/discrepancy/scene/state_changes.h"

namespace pedicel::discrepancy {

namespace {

robot::Trajectory commands_of(const Trial& trial, const Arm& arm) {
  std::vector<Eigen::VectorXd> rows;
  for (int r = 0; r < trial.commands.size(); ++r) {
    Eigen::VectorXd q = rows.empty() ? arm.start() : rows.back();
    for (std::size_t c = 0; c < trial.command_columns.size(); ++c)
      if (const double value = trial.commands.value(r, static_cast<long>(c)); std::isfinite(value))
        q[trial.command_columns[c]] = value;
    rows.push_back(q);
  }
  return {trial.commands.time, rows};
}

}  // namespace

// By differences of the positions. A step's own velocity is that of its middle: taken at its end,
// the spline between two steps would swing by three times the acceleration.
JointPath path_through(std::vector<double> time, const std::vector<Eigen::VectorXd>& positions) {
  std::vector<Eigen::VectorXd> speeds = {Eigen::VectorXd::Zero(positions.front().size())};
  for (std::size_t k = 1; k < positions.size(); ++k) {
    const std::size_t next = std::min(k + 1, positions.size() - 1);
    speeds.emplace_back((positions[next] - positions[k - 1]) / (time[next] - time[k - 1]));
  }
  return JointPath::through(std::move(time), positions, speeds);
}

JointPath run_arm(const Experiment& experiment, const Trial& trial, const SceneState& state,
                  const Arm& arm, double dt, double until) {
  const robot::RobotDescription description = with_friction(arm.description(), state);
  world::WorldSettings settings;
  settings.dt = dt;
  settings.gravity = experiment.scene.gravity;
  world::SimWorld world(settings);
  robot::RobotSettings how;
  how.base_pose = experiment.scene.robot->base;
  how.collide = false;
  robot::Robot robot(description, how, world.bullet());
  const robot::Trajectory commands = commands_of(trial, arm);
  Eigen::VectorXd q = arm.start(), qd = Eigen::VectorXd::Zero(q.size());
  // A row at t holds what was told at t - delay.
  const auto told = [&](double t) { commands.sample(t + state.robot_delay, q, qd); };
  told(0.0);
  qd.setZero();
  robot.reset(q, qd);
  const int steps = static_cast<int>(std::ceil(until / dt - 1.0e-9));
  std::vector<double> time = {0.0};
  std::vector<Eigen::VectorXd> positions = {q};
  Eigen::VectorXd lagged = q, lagged_speed = qd;
  const double lag = state.tracking_lag;
  const double kept = lag > 0.0 ? std::exp(-dt / lag) : 0.0;
  for (int k = 1; k <= steps; ++k) {
    told(k * dt);
    const Eigen::VectorXd before = lagged;
    // First order, exact for a target that goes evenly within a step.
    lagged = q - lag * qd + kept * (before - q + dt * qd + lag * qd);
    lagged_speed = lag > 0.0 ? Eigen::VectorXd((lagged - before) / dt) : qd;
    robot.motors().set_position_targets(lagged, lagged_speed);
    robot.begin_step(dt);
    world.step();
    robot.end_step();
    time.push_back(k * dt);
    positions.push_back(robot.positions());
  }
  return path_through(std::move(time), positions);
}

}  // namespace pedicel::discrepancy
