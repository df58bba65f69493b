#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/sensor_messages.h"
#include "plugins/simulation/instrument.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::simulation {

namespace {

/// The rotation (rad, W) from one turn to another.
Vec3 turn_between(const Quat& from, const Quat& to) {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  return turn.angle() * turn.axis();
}

/// An accelerometer and a gyroscope, in their own frame. As every accelerometer it feels what
/// carries it and no gravity: at rest it says g upward, in free fall nothing. Both are of the
/// middle one of the last three steps' poses, from their differences.
class Imu : public Instrument {
 public:
  Imu(const Simulation& simulation, const world::SceneInstrument& scene)
      : Instrument(scene, simulation.scene().seed, own_frame_name(scene)),
        seat_(simulation, scene),
        gravity_(simulation.scene().gravity),
        now_(*seat_.pose()),
        before_(now_) {}

  std::optional<Pose> own_frame() const override { return now_; }

  std::vector<ros::Definition> message_type() const override {
    return ros::definitions_of<ros::Imu>();
  }
  std::string message() const override {
    const Eigen::VectorXd& now = reading();
    ros::Imu message;
    message.header = {ros::stamp_of(reading_time()), own_frame_name(scene())};
    message.orientation_covariance[0] = -1.0;  // it says none
    message.linear_acceleration = {now[0], now[1], now[2]};
    message.angular_velocity = {now[3], now[4], now[5]};
    for (std::size_t i = 0; i < 9; i += 4) {
      message.linear_acceleration_covariance[i] = std::pow(scene().noise.sizes[0].std, 2);
      message.angular_velocity_covariance[i] = std::pow(scene().noise.sizes[1].std, 2);
    }
    return ros::to_cdr(message);
  }

 protected:
  void measure(world::SimWorld& world, Eigen::VectorXd& exact) override {
    const std::optional<Pose> next = seat_.pose();
    if (!next) return;
    const double dt = world.dt();
    const Vec3 acceleration =
        ((next->position - now_.position) - (now_.position - before_.position)) / (dt * dt);
    const Quat to_own = now_.rotation.conjugate();
    exact << to_own * (acceleration - gravity_),
        to_own * turn_between(before_.rotation, next->rotation) / (2.0 * dt);
    before_ = now_, now_ = *next;
  }

 private:
  Seat seat_;
  Vec3 gravity_;
  Pose now_, before_;  // X_W of its frame, in the last step and the one before
};

}  // namespace

std::unique_ptr<Instrument> make_imu(Simulation& simulation, const world::SceneInstrument& scene) {
  return std::make_unique<Imu>(simulation, scene);
}

}  // namespace pedicel::simulation
