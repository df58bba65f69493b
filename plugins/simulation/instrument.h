#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/random.h"
#include "engine/world/scene.h"
#include "engine/world/sim_world.h"
#include "plugins/simulation/plants/organ_places.h"

namespace pedicel::ros {
struct Definition;
}

namespace pedicel::simulation {

class Simulation;

/// What a sensor says beside what is: a multiple, and a zero that is off.
struct Gauge {
  double gain = 1.0;
  Eigen::VectorXd bias;
};

/// The link that an instrument sits on. Throws UsageError where the robot has none of that name.
int link_of(const Simulation& simulation, const world::SceneInstrument& scene);

/// Where an instrument sits: on a link, or on an organ, which may come off.
class Seat {
 public:
  /// Throws UsageError where there is no such link or organ.
  Seat(const Simulation& simulation, const world::SceneInstrument& scene);
  /// X_W of the instrument's frame, to be asked for once a step. Of what came off it is that of the
  /// body that it became; nothing where there is none.
  std::optional<Pose> pose();

 private:
  std::optional<Pose> pose_on_body(const cosserat::RodState& state, const Pose& now);

  const Simulation& simulation_;
  int link_ = -1, fruit_ = -1;  // index; -1: it sits on none
  PlaceOnPlant place_;
  Pose offset_, last_;
  int body_ = -1;  // that its organ is by now
  Pose pose_B_;    // in that body
};

/// The name of an instrument's own frame: "NAME/KIND".
std::string own_frame_name(const world::SceneInstrument& scene);

/// An instrument of the scene: it looks at each step, and says what it saw at its own rate, with
/// noise, tare and latency. Its numbers are those of its kind's vectors, one after the other.
/// A class of its own file says what they are; CMakeLists.txt has the list.
class Instrument {
 public:
  struct Sample {
    double time = 0.0;  ///< s
    Eigen::VectorXd value;
  };

  /// `noise_name`: of the noise's random numbers, beside the run's seed.
  Instrument(const world::SceneInstrument& scene, int run_seed, const std::string& noise_name,
             Gauge gauge = {});
  virtual ~Instrument() = default;
  Instrument(const Instrument&) = delete;
  Instrument& operator=(const Instrument&) = delete;

  const world::SceneInstrument& scene() const { return scene_; }
  const world::InstrumentKind& kind() const { return scene_.kind(); }

  /// Once a step, in its end.
  void step(world::SimWorld& world);
  /// As it is.
  const Eigen::VectorXd& exact() const { return exact_; }
  /// As the sensor says it, with noise, tare and latency: sampled at its rate, held in between. A
  /// tared sensor says nothing (0) until its first 0.2 s are over: their mean is not known before.
  const Eigen::VectorXd& reading() const { return reading_.value; }
  double reading_time() const { return reading_.time; }  ///< s, of the last sample
  long samples() const { return samples_; }              ///< that were taken
  /// What was added by the last step; of a tared sensor its first 0.2 s come all at once.
  const std::vector<Sample>& new_samples() const { return new_; }

  /// X_W of its frame, where that is own_frame_name() and no link's.
  virtual std::optional<Pose> own_frame() const { return std::nullopt; }
  /// What messages of ROS tell it, and the reading as one (CDR).
  virtual std::vector<ros::Definition> message_type() const = 0;
  virtual std::string message() const = 0;

 protected:
  virtual void measure(world::SimWorld& world, Eigen::VectorXd& exact) = 0;

 private:
  Eigen::VectorXd drawn(double world::InstrumentNoise::Size::*size);
  Eigen::VectorXd noise(double dt);
  const Eigen::VectorXd& late(double time) const;
  void sample(double time);
  void tare();

  world::SceneInstrument scene_;
  Random random_;
  Gauge gauge_;
  Eigen::VectorXd exact_, bias_, walk_;
  std::deque<std::pair<double, Eigen::VectorXd>> past_;
  std::optional<Eigen::VectorXd> tare_;  // nothing: it is not known yet
  std::vector<Sample> untared_, new_;    // taken before it was known; of the last step
  Sample reading_;
  double taken_at_ = 0.0, last_sample_ = 0.0;  // s
  long samples_ = 0;
};

/// All of a scene's, as an observer of its steps.
class Instruments : public world::Observer {
 public:
  /// Faults go to `diagnostics`.
  Instruments(Simulation& simulation, Diagnostics& diagnostics);

  void observe(const world::SimWorld& world, const world::WorldReport& report) override;
  const std::vector<std::unique_ptr<Instrument>>& all() const { return all_; }

 private:
  world::SimWorld& world_;
  std::vector<std::unique_ptr<Instrument>> all_;
};

/// The class of a kind of instrument. It throws UsageError where what it sits on is not there.
using MakeInstrument = std::unique_ptr<Instrument> (*)(Simulation& simulation,
                                                       const world::SceneInstrument& scene);
MakeInstrument maker_of(const world::InstrumentKind& kind);

}  // namespace pedicel::simulation
