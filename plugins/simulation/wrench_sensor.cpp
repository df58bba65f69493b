#include "plugins/simulation/wrench_sensor.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "plugins/simulation/body_contacts.h"
#include "plugins/simulation/colliders.h"

namespace pedicel::simulation {

namespace {

constexpr double tare_time = 0.2;  // s

Wrench drawn(Random& random, double force, double moment) {
  Wrench values;
  for (int i = 0; i < 6; ++i) values[i] = (i < 3 ? force : moment) * random.normal();
  return values;
}

std::vector<int> links_beyond(const robot::RobotDescription& robot, int link) {
  std::vector<int> all = {link};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const robot::Joint& joint : robot.joints)
      if (joint.parent == all[i]) all.push_back(joint.child);
  return all;
}

/// Another seed for each sensor of a run.
std::uint64_t seed_of(std::uint64_t run, const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325ull ^ run;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return hash;
}

}  // namespace

WrenchNoiseSource::WrenchNoiseSource(const world::WrenchNoise& noise, std::uint64_t seed)
    : noise_(noise),
      random_(seed),
      bias_(drawn(random_, noise.force_bias, noise.moment_bias)),
      walk_(Wrench::Zero()) {}

Wrench WrenchNoiseSource::next(double dt) {
  walk_ += std::sqrt(dt) * drawn(random_, noise_.force_walk, noise_.moment_walk);
  return bias_ + walk_ + drawn(random_, noise_.force_std, noise_.moment_std);
}

WrenchSensor::WrenchSensor(const world::SceneWrench& scene, RobotControl& robot,
                           const PlantStep& plants, const Vec3& gravity, std::uint64_t seed,
                           const WrenchGauge& gauge)
    : scene_(scene),
      robot_(robot),
      plants_(plants),
      gravity_(gravity),
      link_(robot.description().link(scene.link)),
      noise_(scene.noise, seed_of(seed, scene.name)),
      gauge_(gauge) {
  if (!scene.tared) tare_ = Wrench::Zero();
  if (link_ < 0)
    throw UsageError("wrench " + in_quotes(scene.name) + ": the robot has no link " +
                     in_quotes(scene.link));
  beyond_ = links_beyond(robot.description(), link_);
  for (const int link : beyond_) before_.push_back(robot.link_pose(link));
}

void WrenchSensor::step(world::SimWorld& world) {
  const double time = world.time();
  measure(world);
  if (scene_.noise.latency > 0.0) {
    past_.emplace_back(time, exact_);
    while (past_.size() > 1 && past_[1].first <= time - scene_.noise.latency + 1.0e-9)
      past_.pop_front();
  }
  // The first sample at or after each multiple of the sampling time.
  const double due = std::floor(time * scene_.rate + 1.0e-6) / scene_.rate;
  new_.clear();
  if (due > last_sample_ + 0.5 / scene_.rate) sample(time);
  if (!tare_ && !untared_.empty() && time >= tare_time - 1.0e-9) tare();
}

void WrenchSensor::add_bodies(world::SimWorld& world, Vec3& force, Vec3& moment) const {
  each_body_contact(world, robot_.robot(), [&](int link, const Vec3& force_W, const Vec3& place_W) {
    const bool felt = scene_.touch ? link == link_ : std::ranges::count(beyond_, link) > 0;
    if (!felt) return;
    force += force_W;
    moment += place_W.cross(force_W);
  });
}

void WrenchSensor::measure(world::SimWorld& world) {
  const double dt = world.dt();
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // W, about the world's origin
  Vec3 momentum = Vec3::Zero(), spin = Vec3::Zero();
  const std::size_t links = scene_.touch ? 1 : beyond_.size();
  for (std::size_t i = 0; i < links; ++i) {
    const coupling::ContactSum touch = plants_.contacts().sum_of_link(robot_body, beyond_[i]);
    force += touch.force_W;
    moment += touch.place_W.cross(touch.force_W) + touch.moment_W;
    if (scene_.touch) break;
    const robot::Inertial& mass =
        robot_.description().links[static_cast<std::size_t>(beyond_[i])].inertial;
    const Pose now = robot_.link_pose(beyond_[i]);
    const Vec3 com = now * mass.com_L, velocity = (com - before_[i] * mass.com_L) / dt;
    const Eigen::AngleAxisd turn(now.rotation * before_[i].rotation.conjugate());
    const double angle = turn.angle() > M_PI ? turn.angle() - 2.0 * M_PI : turn.angle();
    const Mat3 axes = now.rotation.toRotationMatrix();
    force += mass.mass * gravity_;
    moment += com.cross(mass.mass * gravity_);
    momentum += mass.mass * velocity;
    spin += com.cross(mass.mass * velocity) +
            axes * mass.inertia * axes.transpose() * (angle / dt * turn.axis());
    before_[i] = now;
  }
  add_bodies(world, force, moment);
  if (moved_ && !scene_.touch) {
    force -= (momentum - momentum_) / dt;
    moment -= (spin - spin_) / dt;
  }
  momentum_ = momentum, spin_ = spin, moved_ = true;
  const Pose at = robot_.link_pose(link_);
  exact_ << at.rotation.conjugate() * force,
      at.rotation.conjugate() * (moment - at.position.cross(force));
}

Wrench WrenchSensor::late(double time) const {
  if (past_.empty()) return exact_;
  const double shown = time - scene_.noise.latency + 1.0e-9;
  const auto later =
      std::ranges::find_if(past_, [&](const auto& one) { return one.first > shown; });
  return later == past_.begin() ? past_.front().second : std::prev(later)->second;
}

void WrenchSensor::sample(double time) {
  const Sample taken{time, gauge_.gain * late(time) + gauge_.bias +
                               noise_.next(samples_ == 0 ? 0.0 : time - taken_at_)};
  taken_at_ = time;
  last_sample_ = std::floor(time * scene_.rate + 1.0e-6) / scene_.rate;
  ++samples_;
  if (!tare_) return untared_.push_back(taken);
  reading_ = {time, taken.value - *tare_};
  new_.push_back(reading_);
}

void WrenchSensor::tare() {
  Wrench sum = Wrench::Zero();
  for (const Sample& one : untared_) sum += one.value;
  tare_ = sum / static_cast<double>(untared_.size());
  for (const Sample& one : untared_) new_.push_back({one.time, one.value - *tare_});
  reading_ = new_.back();
  untared_.clear();
}

WrenchSensors::WrenchSensors(const world::Scene& scene, RobotControl& robot,
                             const PlantStep& plants, world::SimWorld& world,
                             std::span<const WrenchGauge> gauges, Diagnostics& diagnostics)
    : world_(world) {
  for (const world::SceneWrench& one : scene.wrenches) try {
      const auto index = static_cast<std::size_t>(&one - scene.wrenches.data());
      sensors_.emplace_back(one, robot, plants, scene.gravity,
                            static_cast<std::uint64_t>(scene.seed),
                            gauges.empty() ? WrenchGauge{} : gauges[index]);
    } catch (const UsageError& fault) {
      diagnostics.error(one.where, fault.what());
    }
}

void WrenchSensors::observe(const world::SimWorld&, const world::WorldReport&) {
  for (WrenchSensor& one : sensors_) one.step(world_);
}

}  // namespace pedicel::simulation
