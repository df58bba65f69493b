#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>

#include "app/python/arrays.h"
#include "app/python/process.h"
#include "app/sense/scene_sensors.h"
#include "app/steer/steered_run.h"

namespace pedicel::python {

/// The cameras of a simulation: made with the first picture of it, and anew after a reset.
struct RunSensors {
  long seed = 0;  // of everything random of the run
  std::unique_ptr<app::SceneSensors> of_run;
  long generation = -1;  // SteeredRun::generation() that they are of

  /// With the run's lock.
  app::SceneSensors& of(app::SteeredRun& run);
  /// To be called after each step: a late camera keeps what it saw.
  void remember(app::SteeredRun& run);
};

/// A run that Python leads: a Simulation, or one of several Worlds. One call at a time works on it;
/// others wait, without the interpreter's lock.
class Run {
 public:
  virtual ~Run() = default;
  virtual app::SteeredRun& run() = 0;
  virtual app::StateArrays& state() = 0;
  virtual std::mutex& mutex() = 0;
  /// Throws UsageError where the run's threads stayed behind in another process.
  virtual void check_process() const = 0;
  virtual int world() const { return 0; }
  /// Its cameras: all handles of a world share them.
  virtual RunSensors& sensed() = 0;

  /// Does what is given with the run, alone and without the interpreter's lock. No Python object
  /// may be made meanwhile.
  template <class Task>
  auto alone(const Task& task) {
    check_process();
    const pybind11::gil_scoped_release release;
    const std::lock_guard lock(mutex());
    return task(run());
  }
  void fill() { state().fill(run().simulation(), world()); }
  /// All worlds that share the arrays.
  virtual void fill_all() { fill(); }

  void step(long count);
  void reset(const std::optional<long>& wanted_seed, const pybind11::dict& settings);
  void act(app::Act act);
  pybind11::array_t<std::uint8_t> render(const std::string& camera, int width, int height,
                                         bool strain, bool text);
  app::SensedPicture sense(const app::SenseRequest& wanted);
  std::vector<app::NamedThing> things();
};

/// The seed. Throws UsageError where it is negative.
long checked_seed(long seed);

/// Class pedicel.Run with everything that a run can do.
void add_run_class(pybind11::module_& module);
/// What cameras see: classes CameraPicture, Keypoint and Thing, and what a Run has of them.
void add_camera_classes(pybind11::module_& module);
void add_cameras(pybind11::class_<Run>& run);
void add_simulation_class(pybind11::module_& module);
void add_worlds_class(pybind11::module_& module);

}  // namespace pedicel::python
