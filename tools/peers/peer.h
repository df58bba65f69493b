#pragma once

#include <functional>
#include <memory>

#include "scene.h"

namespace peers {

/// What a peer has to offer: some plants, at rest as drawn, that it can step.
class World {
 public:
  virtual ~World() = default;
  /// Gravity (m/s2, downward) and drag (1/s, force = -drag x mass x velocity) from now on.
  virtual void set_environment(double gravity, double drag) = 0;
  virtual void step() = 0;
  /// Where the far end of an element is (m, W).
  virtual Vector3d end(int plant, int element) const = 0;
};

/// Builds a world of plants that takes steps of `dt` (s).
using MakeWorld =
    std::function<std::unique_ptr<World>(const std::vector<Plant>& plants, double dt)>;

/// The whole program of a peer. Usage: PEER WORK DT THREADS SECONDS, where WORK is
///   forest | tree    speed over about SECONDS of wall time, at most 2 s simulated; with two
///                    threads half of the plants are in a world of their own
///   tip20 | tip40    drop of the heavy cantilever's tip, settled under a strong drag
///   ring20           first frequency and numerical damping of its free vibration
///   droop            settled drop of the forest's ends
/// Prints one JSON object; "unstable": true where a position is not finite. What takes much longer
/// than it may is the caller's to end.
int run(int argc, char** argv, const MakeWorld& make_world);

}  // namespace peers
