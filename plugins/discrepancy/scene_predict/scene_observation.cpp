#include "plugins/discrepancy/scene_predict/scene_observation.h"

#include <cmath>

#include "engine/robot/dynamics.h"
#include "plugins/discrepancy/scene/camera.h"
#include "plugins/discrepancy/simulate/observation.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

constexpr double unseen = std::numeric_limits<double>::quiet_NaN();
/// rad/s or m/s: a joint's friction grows with tanh(speed / creeping), so that rest bears none.
constexpr double creeping = 1.0e-2;

using MotionRows = SceneMotion::Rows;

/// The mean of a table of steps over [from, to], which is linear between them.
Eigen::RowVectorXd mean_over(const std::vector<double>& time, const MotionRows& rows, long first,
                             long count, double from, double to) {
  from = std::clamp(from, time.front(), time.back());
  to = std::clamp(to, time.front(), time.back());
  const auto at = [&](double t) -> Eigen::RowVectorXd {
    const Interval i = find_interval(time, t);
    if (i.length == 0.0) return rows.row(i.row).segment(first, count);
    return (1.0 - i.share) * rows.row(i.row).segment(first, count) +
           i.share * rows.row(i.row + 1).segment(first, count);
  };
  if (!(to > from)) return at(from);
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(count);
  double begin = from;
  Eigen::RowVectorXd last = at(from);
  for (auto next = std::upper_bound(time.begin(), time.end(), from);; ++next) {
    const double end = next == time.end() ? to : std::min(*next, to);
    const Eigen::RowVectorXd value = at(end);
    sum += 0.5 * (end - begin) * (last + value);
    begin = end;
    last = value;
    if (end >= to) break;
  }
  return sum / (to - from);
}

/// s, half a sample.
double half_sample(const std::vector<double>& time) {
  if (time.size() < 2) return 0.0;
  return 0.5 * (time.back() - time.front()) / static_cast<double>(time.size() - 1);
}

class Observer {
 public:
  Observer(const Experiment& experiment, const SceneMotion& motion, const SceneMember& member,
           std::span<const plant::Effect> all)
      : experiment_(experiment), motion_(motion), member_(member) {
    for (const Marker& marker : experiment.markers) sensor_.markers.push_back(marker.name);
    sensor_.offset.assign(experiment.markers.size(), Vec3::Zero());
    for (const plant::Effect& effect : all) effects::apply_to_sensor(effect, sensor_);
  }

  /// m, W, where all markers are, 3 a marker; NaN beyond the motion.
  Eigen::RowVectorXd places(double t) {
    Eigen::RowVectorXd out =
        Eigen::RowVectorXd::Constant(3 * static_cast<long>(experiment_.markers.size()), unseen);
    if (t < 0.0) t = 0.0;
    const Interval at = find_interval(motion_.time, t);
    if (at.row < 0) return out;
    bool posed = false;
    for (std::size_t m = 0; m < experiment_.markers.size(); ++m) {
      const Marker& marker = experiment_.markers[m];
      const auto c = static_cast<long>(m);
      Vec3 place;
      if (marker.plant < 0) {
        if (!posed) {
          member_.arm->model().link_poses(joints(t, 0.0).q, links_);
          posed = true;
        }
        const Pose& link = links_[static_cast<std::size_t>(marker.link)];
        place = link * marker.offset_L + link.rotation * sensor_.offset[m];
      } else {
        place = plant_marker(at, c);
        if (!sensor_.offset[m].isZero(0.0)) {
          const Quat turn(motion_.turn.row(at.row).segment<4>(4 * c).data());
          place += turn * sensor_.offset[m];
        }
      }
      out.segment<3>(3 * c) = (sensor_.frame * place).transpose();
    }
    return out;
  }

  Eigen::MatrixXd markers(const Samples& samples) {
    Eigen::MatrixXd out(samples.size(), 3 * static_cast<long>(experiment_.markers.size()));
    for (int s = 0; s < samples.size(); ++s)
      out.row(s) = places(samples.time[static_cast<std::size_t>(s)] - sensor_.delay);
    return out;
  }

  Eigen::MatrixXd pixels(const Samples& samples, const Camera& camera) {
    const long count = static_cast<long>(experiment_.markers.size());
    Eigen::MatrixXd out(samples.size(), 2 * count);
    for (int s = 0; s < samples.size(); ++s) {
      const Eigen::RowVectorXd at =
          places(samples.time[static_cast<std::size_t>(s)] - sensor_.delay);
      for (long m = 0; m < count; ++m)
        out.row(s).segment<2>(2 * m) =
            image_of(camera, at.segment<3>(3 * m).transpose()).transpose();
    }
    return out;
  }

  Eigen::MatrixXd wrench(const Samples& samples, std::size_t index) const {
    const WrenchSensor& sensor = experiment_.wrenches[index];
    const SceneState::Gauge& gauge = member_.state->gauges[index];
    const double half = half_sample(samples.time);
    robot::Dynamics dynamics(member_.arm->description(), member_.arm->model());
    const robot::CarriedLinks links(member_.arm->description(), sensor.link);
    Eigen::MatrixXd out(samples.size(), 6);
    for (int s = 0; s < samples.size(); ++s) {
      const double t = samples.time[static_cast<std::size_t>(s)];
      if (t > motion_.time.back() + half) {
        out.row(s).setConstant(unseen);
        continue;
      }
      const long column = 6 * static_cast<long>(index);
      if (const double dt = member_.run_step; dt > 0.0) {
        // What a run says in the middle of a step is the step's.
        const double end = t + 0.5 * dt;
        out.row(s) =
            weight_in_step(links, joints(end - dt, 0.0), joints(end, 0.0), dt).transpose() +
            mean_over(motion_.time, motion_.contact, column, 6, end, end);
        continue;
      }
      const JointPath::Point q = joints(t, half);
      dynamics.inverse(q.q, q.qd, q.qdd, experiment_.scene.gravity);
      out.row(s) = dynamics.carried_wrench(sensor.link).transpose() +
                   mean_over(motion_.time, motion_.contact, column, 6, t - half, t + half);
    }
    out *= gauge.gain;
    out.leftCols<3>().rowwise() += gauge.force.transpose();
    out.rightCols<3>().rowwise() += gauge.moment.transpose();
    if (sensor.tared) take_off_tare(samples, out);
    return out;
  }

  Eigen::MatrixXd torques(const Trial& trial) {
    const Samples& samples = trial.torques;
    const robot::KinematicModel& model = member_.arm->model();
    robot::Dynamics dynamics(member_.arm->description(), model);
    const double half = half_sample(samples.time);
    Eigen::MatrixXd out(samples.size(), static_cast<long>(trial.torque_columns.size()));
    for (int s = 0; s < samples.size(); ++s) {
      const double t = samples.time[static_cast<std::size_t>(s)] - member_.state->robot_delay;
      if (t > motion_.time.back() + half) {
        out.row(s).setConstant(unseen);
        continue;
      }
      const JointPath::Point at = arm_at(member_, t);
      Eigen::VectorXd effort = dynamics.inverse(at.q, at.qd, at.qdd, experiment_.scene.gravity);
      for (int d = 0; d < model.dofs(); ++d) effort[d] += resistance(d, at.qd[d]);
      effort -= load(t, half);
      for (std::size_t c = 0; c < trial.torque_columns.size(); ++c)
        out(s, static_cast<long>(c)) = effort[trial.torque_columns[c]];
    }
    return out;
  }

  /// What encoders read of an arm that follows commands.
  Eigen::MatrixXd encoders(const Trial& trial) const {
    Eigen::MatrixXd out(trial.joints.size(), static_cast<long>(trial.joint_columns.size()));
    for (int s = 0; s < trial.joints.size(); ++s) {
      const double t = trial.joints.time[static_cast<std::size_t>(s)] - member_.state->robot_delay;
      const Eigen::VectorXd q = member_.path->at(t).q - member_.state->joint_offset;
      for (long c = 0; c < out.cols(); ++c)
        out(s, c) = q[trial.joint_columns[static_cast<std::size_t>(c)]];
    }
    return out;
  }

 private:
  // Of the links, which give way beyond the encoders; means over `half` to either side.
  JointPath::Point joints(double t, double half) const {
    JointPath::Point point = arm_at(member_, t);
    if (motion_.given.size() == 0) return point;
    const Eigen::RowVectorXd given =
        mean_over(motion_.time, motion_.given, 0, motion_.given.cols(), t - half, t + half);
    const long dofs = point.q.size();
    point.q += given.segment(0, dofs).transpose();
    point.qd += given.segment(dofs, dofs).transpose();
    point.qdd += given.segment(2 * dofs, dofs).transpose();
    return point;
  }

  // Of a step of `dt` (s), as a run makes it.
  robot::Wrench weight_in_step(const robot::CarriedLinks& links, const JointPath::Point& begin,
                               const JointPath::Point& end, double dt) const {
    std::vector<Pose> poses;
    std::vector<robot::Twist> twists;
    const auto momentum = [&](const JointPath::Point& at) {
      member_.arm->model().link_poses(at.q, poses);
      member_.arm->model().link_velocities(poses, at.qd, twists);
      return links.momentum(poses, twists);
    };
    const auto before = momentum(begin), now = momentum(end);
    return links.weight(poses, before, now, dt, experiment_.scene.gravity);
  }

  // N m, of plants on the motors: through the springs, where there are any.
  Eigen::VectorXd load(double t, double half) const {
    const long dofs = motion_.effort.cols();
    if (motion_.given.size() == 0)
      return mean_over(motion_.time, motion_.effort, 0, dofs, t - half, t + half).transpose();
    const Eigen::VectorXd given =
        mean_over(motion_.time, motion_.given, 0, 2 * dofs, t - half, t + half).transpose();
    return member_.state->joint_stiffness *
           (given.head(dofs) + member_.state->joint_damping_time * given.tail(dofs));
  }

  Vec3 plant_marker(const Interval& at, long marker) const {
    const auto triple = [&](const MotionRows& rows, int row) -> Vec3 {
      return rows.row(row).segment<3>(3 * marker).transpose();
    };
    const Vec3 p0 = triple(motion_.position, at.row);
    if (at.length == 0.0) return p0;
    const Vec3 v0 = triple(motion_.velocity, at.row), v1 = triple(motion_.velocity, at.row + 1);
    const Vec3 rise = triple(motion_.position, at.row + 1) - p0;
    const double u = at.share, w = 1.0 - u;
    return p0 + u * u * (3.0 - 2.0 * u) * rise + at.length * u * w * (w * v0 - u * v1);
  }

  // N m, what damping and friction of a joint take, the URDF's and the state's.
  double resistance(int dof, double speed) const {
    const robot::RobotDescription& robot = member_.arm->description();
    const robot::Joint& joint =
        robot
            .joints[robot.joint(member_.arm->model().joint_names()[static_cast<std::size_t>(dof)])];
    const double sign = std::tanh(speed / creeping);
    return (joint.damping + member_.state->viscous[dof]) * speed +
           (joint.friction + member_.state->coulomb[dof]) * sign;
  }

  void take_off_tare(const Samples& samples, Eigen::MatrixXd& out) const {
    int count = 0;
    while (count < samples.size() &&
           samples.time[static_cast<std::size_t>(count)] <= samples.time.front() + tare_time)
      ++count;
    if (count > 0) out.rowwise() -= out.topRows(count).colwise().mean().eval();
  }

  const Experiment& experiment_;
  const SceneMotion& motion_;
  const SceneMember& member_;
  effects::SensorState sensor_;
  std::vector<Pose> links_;
};

}  // namespace

SceneReadings observe_scene(const Experiment& experiment, const Trial& trial,
                            const SceneMotion& motion, const SceneMember& member,
                            std::span<const plant::Effect> effects) {
  SceneReadings out;
  out.healthy = motion.healthy;
  out.events = motion.events;
  Observer observer(experiment, motion, member, effects);
  out.markers = observer.markers(trial.markers);
  for (std::size_t c = 0; c < trial.pixels.size(); ++c)
    out.pixels.push_back(observer.pixels(trial.pixels[c], member.state->cameras[c]));
  for (std::size_t w = 0; w < trial.wrenches.size(); ++w)
    out.wrenches.push_back(observer.wrench(trial.wrenches[w], w));
  out.torques = observer.torques(trial);
  if (trial.follows_commands) out.joints = observer.encoders(trial);
  return out;
}

}  // namespace pedicel::discrepancy
