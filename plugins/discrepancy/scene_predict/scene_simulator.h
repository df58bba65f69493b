#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <span>

#include "plugins/discrepancy/scene_predict/scene_observation.h"

namespace pedicel::discrepancy {

/// A model of a measured scene on top of what its files state: effects of plants, instruments and
/// of the scene as a whole.
struct SceneVariant {
  std::vector<plant::Effect> effects;
  /// Not 0: the arm goes as readings with other noise of the same size would say, one such draw a
  /// number.
  int draw = 0;
  std::vector<SceneForce> forces{};
  bool plants_away = false;  ///< plants stand far below, where nothing touches them
};

/// Simulates the trials of a measured scene with many variants of its model.
class SceneSimulator {
 public:
  /// Keeps a reference to the experiment. Once `stop` is set, run() returns early: what is not done
  /// is unhealthy. Throws InvalidFile where a plant cannot be built.
  SceneSimulator(const Experiment& experiment, const SceneNumerics& numerics, int threads,
                 const std::atomic<bool>* stop = nullptr);
  ~SceneSimulator();

  struct Request {
    const SceneVariant* variant = nullptr;
    int trial = 0;
    double until = std::numeric_limits<double>::infinity();  ///< s
  };
  /// One prediction a request, in their order. Throws UsageError where an effect cannot be
  /// simulated.
  std::vector<SceneReadings> run(std::span<const Request> requests);

  const Experiment& experiment() const;
  const SceneNumerics& numerics() const;
  long simulations() const;  ///< trials simulated so far

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The arm's joints in a trial, smoothed within their noise, in the order of the robot's model.
/// `draw`: as SceneVariant's.
JointPath path_of(const Experiment& experiment, const Trial& trial, int draw = 0);

}  // namespace pedicel::discrepancy
