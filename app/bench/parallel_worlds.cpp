#include "app/bench/parallel_worlds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/bench/process_memory.h"
#include "engine/core/check.h"
#include "engine/core/thread_pool.h"
#include "engine/core/timer.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

namespace {

using Worlds = std::vector<std::unique_ptr<ParallelWorld>>;

class RodWorld : public ParallelWorld {
 public:
  RodWorld(const BenchOptions& options, const std::vector<cosserat::RodModel>& plants)
      : rods_(options.rods), dt_(options.dt) {
    for (const cosserat::RodModel& model : plants) add_bench_plant(rods_, model, options);
  }
  void step() override { rods_.step(dt_, bench_gravity); }
  std::uint64_t state_hash() const override {
    StateHash hash;
    rods_.add_to(hash);
    return hash.value();
  }

 private:
  cosserat::RodSystem rods_;
  double dt_;
};

class SceneWorld : public ParallelWorld {
 public:
  explicit SceneWorld(std::shared_ptr<const simulation::SceneAssets> assets)
      : simulation_(std::move(assets)) {}
  void step() override {
    if (!fatal_errors_) fatal_errors_ = simulation_.step().errors & world::fatal_errors;
  }
  std::uint64_t state_hash() const override { return simulation_.state_hash(); }
  std::string failure() const override {
    return fatal_errors_ ? world::remedy(static_cast<world::WorldError>(fatal_errors_)) : "";
  }

 private:
  simulation::Simulation simulation_;
  unsigned fatal_errors_ = 0;
};

// Wall seconds. A world stays with its thread to the end: no waiting for each other, warm caches.
double step_all(const Worlds& worlds, long steps, ThreadPool& pool) {
  const Timer timer;
  pool.for_each(static_cast<int>(worlds.size()), [&](int w) {
    for (long i = 0; i < steps; ++i) worlds[w]->step();
  });
  return timer.seconds();
}

// Sum of the simulated s / wall s.
double real_time_factor(const Worlds& worlds, const WorldsOptions& options, ThreadPool& pool) {
  constexpr long warm_up = 10;
  const long steps = std::max(1L, std::lround(options.duration / options.dt));
  step_all(worlds, warm_up, pool);
  const double seconds = step_all(worlds, steps, pool);
  return static_cast<double>(worlds.size()) * static_cast<double>(steps) * options.dt / seconds;
}

Worlds make_worlds(const MakeWorld& make, int count) {
  Worlds worlds;
  for (int w = 0; w < count; ++w) worlds.push_back(make());
  return worlds;
}

void check(const ParallelWorld& world, std::size_t number, std::uint64_t expected_hash) {
  const std::string name = "world " + std::to_string(number);
  if (const std::string failure = world.failure(); !failure.empty())
    throw UnstableWorld(name + " is unstable: " + failure);
  if (world.state_hash() != expected_hash)
    throw std::runtime_error(name + " ended in another state than one alone");
}

}  // namespace

MakeWorld rod_worlds(const BenchOptions& options) {
  const auto plants =
      std::make_shared<const std::vector<cosserat::RodModel>>(bench_plants(options.name));
  return [options, plants] { return std::make_unique<RodWorld>(options, *plants); };
}

MakeWorld scene_worlds(const world::Scene& scene, const simulation::SimulationOptions& options) {
  world::Scene single = scene;
  single.threads = 1;
  const auto assets = std::make_shared<const simulation::SceneAssets>(single, options);
  return [assets] { return std::make_unique<SceneWorld>(assets); };
}

WorldsResult run_worlds(const MakeWorld& make, const WorldsOptions& options) {
  if (options.worlds < 1)
    throw UsageError("worlds = " + std::to_string(options.worlds) + ": must be >= 1");
  WorldsResult result;
  result.worlds = options.worlds;
  result.threads = options.threads;
  result.dt = options.dt;
  result.duration = options.duration;
  ThreadPool single(1), pool(options.threads);

  const Worlds alone = make_worlds(make, 1);
  result.one_real_time_factor = real_time_factor(alone, options, single);
  result.state_hash = alone.front()->state_hash();
  check(*alone.front(), 1, result.state_hash);

  const double before = resident_bytes();
  const Worlds worlds = make_worlds(make, options.worlds);
  result.real_time_factor = real_time_factor(worlds, options, pool);
  result.megabytes_per_world = (resident_bytes() - before) / (1024.0 * 1024.0) / options.worlds;
  for (std::size_t w = 0; w < worlds.size(); ++w) check(*worlds[w], w + 1, result.state_hash);
  return result;
}

std::string to_json(const WorldsResult& r) {
  const nlohmann::ordered_json json = {{"worlds", r.worlds},
                                       {"threads", r.threads},
                                       {"dt", r.dt},
                                       {"duration", r.duration},
                                       {"one_real_time_factor", r.one_real_time_factor},
                                       {"real_time_factor", r.real_time_factor},
                                       {"megabytes_per_world", r.megabytes_per_world},
                                       {"state_hash", hexadecimal(r.state_hash)}};
  return json.dump(2);
}

std::string to_text(const WorldsResult& r) {
  char line[300];
  std::snprintf(line, sizeof line,
                "%d world%s, %d thread%s, dt 1/%.0f s, %.2f s each: %.2f x real time in total, "
                "%.2f x that of one world alone (%.2f x real time); %.2f MiB a world\n",
                r.worlds, r.worlds == 1 ? "" : "s", r.threads, r.threads == 1 ? "" : "s",
                1.0 / r.dt, r.duration, r.real_time_factor,
                r.real_time_factor / r.one_real_time_factor, r.one_real_time_factor,
                r.megabytes_per_world);
  return line + ("state hash of every world and of one alone " + hexadecimal(r.state_hash));
}

}  // namespace pedicel::app
