#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/random.h"
#include "engine/world/scene.h"
#include "plugins/simulation/plants/plant_step.h"
#include "plugins/simulation/robot_control.h"

namespace pedicel::simulation {

/// Force (N) and moment (N m).
using Wrench = Eigen::Matrix<double, 6, 1>;

/// What a sensor says beside what acts: a multiple, and a zero that is off.
struct WrenchGauge {
  double gain = 1.0;
  Wrench bias = Wrench::Zero();
};

/// The noise of a force sensor over a run.
class WrenchNoiseSource {
 public:
  WrenchNoiseSource(const world::WrenchNoise& noise, std::uint64_t seed);
  /// `dt` (s) after the sample before.
  Wrench next(double dt);

 private:
  world::WrenchNoise noise_;
  Random random_;
  Wrench bias_, walk_;
};

/// A force sensor of the scene (SceneWrench). At a wrist it is what the link and all beyond it
/// exert on what carries it: their weight, less what their motion takes, and what plants and rigid
/// bodies exert on them. At a fingertip it is what plants and bodies exert on the link.
class WrenchSensor {
 public:
  /// Throws UsageError where the robot has no such link.
  WrenchSensor(const world::SceneWrench& scene, RobotControl& robot, const PlantStep& plants,
               const Vec3& gravity, std::uint64_t seed, const WrenchGauge& gauge = {});

  struct Sample {
    double time = 0.0;  ///< s
    Wrench value;
  };

  const world::SceneWrench& scene() const { return scene_; }
  /// Once a step, in its end.
  void step(world::SimWorld& world);
  /// As it is, in the link's frame about its origin.
  const Wrench& exact() const { return exact_; }
  /// As the sensor says it, with noise, tare and latency: sampled at its rate, held in between. A
  /// tared sensor says nothing (0) until its first 0.2 s are over: their mean is not known before.
  const Wrench& reading() const { return reading_.value; }
  double reading_time() const { return reading_.time; }  ///< s, of the last sample
  long samples() const { return samples_; }              ///< that were taken
  /// What was added by the last step; of a tared sensor its first 0.2 s come all at once.
  const std::vector<Sample>& new_samples() const { return new_; }

 private:
  void measure(world::SimWorld& world);
  void add_bodies(world::SimWorld& world, Vec3& force, Vec3& moment) const;
  void sample(double time);
  void tare();
  Wrench late(double time) const;

  world::SceneWrench scene_;
  RobotControl& robot_;
  const PlantStep& plants_;
  Vec3 gravity_;
  int link_ = -1;
  std::vector<int> beyond_;                             // links: it and all that hangs on it
  std::vector<Pose> before_;                            // of beyond_, W
  Vec3 momentum_ = Vec3::Zero(), spin_ = Vec3::Zero();  // N s; N m s, about the world's origin
  bool moved_ = false;                                  // momentum_ is known
  std::deque<std::pair<double, Wrench>> past_;
  WrenchNoiseSource noise_;
  WrenchGauge gauge_;
  Wrench exact_ = Wrench::Zero();
  std::optional<Wrench> tare_;         // nothing: it is not known yet
  std::vector<Sample> untared_, new_;  // taken before it was known; of the last step
  Sample reading_{0.0, Wrench::Zero()};
  double taken_at_ = 0.0, last_sample_ = 0.0;  // s
  long samples_ = 0;
};

/// All of a scene's, as an observer of its steps.
class WrenchSensors : public world::Observer {
 public:
  /// Faults go to `diagnostics`.
  /// `gauges`: one a sensor, or none.
  WrenchSensors(const world::Scene& scene, RobotControl& robot, const PlantStep& plants,
                world::SimWorld& world, std::span<const WrenchGauge> gauges,
                Diagnostics& diagnostics);

  void observe(const world::SimWorld& world, const world::WorldReport& report) override;
  const std::vector<WrenchSensor>& all() const { return sensors_; }

 private:
  world::SimWorld& world_;
  std::vector<WrenchSensor> sensors_;
};

}  // namespace pedicel::simulation
