#pragma once

#include <cstdint>
#include <stdexcept>

#include "plugins/discrepancy/scene_predict/scene_simulator.h"

namespace pedicel::discrepancy {

struct SceneObserveOptions {
  SceneNumerics numerics;
  std::uint64_t seed = 1;
  int threads = 1;
  bool noise = true;  ///< that of the instruments, as far as it is stated
};

class SceneFailed : public std::runtime_error {
  using runtime_error::runtime_error;
};

/// What the instruments of `like` would report of a variant of its scene, at its own times: a
/// measured experiment made by simulation. Gaps stay gaps; where a table is empty nothing is made.
/// Throws SceneFailed where a trial cannot be simulated.
Experiment observed_scene(Experiment like, const SceneVariant& variant,
                          const SceneObserveOptions& options);

}  // namespace pedicel::discrepancy
