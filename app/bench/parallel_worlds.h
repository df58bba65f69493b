#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/bench/bench.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// One of many independent copies of the same thing; one thread at a time steps it.
class ParallelWorld {
 public:
  virtual ~ParallelWorld() = default;
  virtual void step() = 0;  ///< by WorldsOptions::dt; does not throw
  virtual std::uint64_t state_hash() const = 0;
  /// Why it cannot go on; empty: it can.
  virtual std::string failure() const { return {}; }
};

/// Makes one more copy, in its starting state. What worlds only read they share.
using MakeWorld = std::function<std::unique_ptr<ParallelWorld>()>;

/// Worlds of one of bench_names(): one RodSystem each. Throws UsageError for an unknown name.
MakeWorld rod_worlds(const BenchOptions& options);

/// Worlds of a scene: a whole Simulation each, with one thread. Throws InvalidFile.
MakeWorld scene_worlds(const world::Scene& scene, const simulation::SimulationOptions& options);

struct WorldsOptions {
  int worlds = 1, threads = 1;
  double dt = 1.0 / 240.0;  ///< s
  double duration = 2.0;    ///< s, simulated by each world, after the warm-up
};

/// The speed of many worlds beside that of one.
struct WorldsResult {
  int worlds = 0, threads = 0;
  double dt = 0.0, duration = 0.0;    ///< s
  double one_real_time_factor = 0.0;  ///< simulated s / wall s, of one world alone on one thread
  double real_time_factor = 0.0;      ///< sum of all worlds' simulated s / wall s
  double megabytes_per_world = 0.0;   ///< MiB, growth of the resident memory, warm
  std::uint64_t state_hash = 0;       ///< of the final state of every world and of one alone
};

/// A world that could not go on (exit code 4).
class UnstableWorld : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Steps one world alone, then all of them, shared among the threads; each is stepped by one.
/// Throws UsageError where a number is below 1, UnstableWorld, and std::runtime_error where a world
/// ends in another state than one alone.
WorldsResult run_worlds(const MakeWorld& make, const WorldsOptions& options);

/// The keys of WorldsResult as JSON, one object.
std::string to_json(const WorldsResult& result);

/// The same for people.
std::string to_text(const WorldsResult& result);

}  // namespace pedicel::app
