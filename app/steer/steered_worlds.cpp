#include "app/steer/steered_worlds.h"

#include <exception>
#include <mutex>
#include <thread>

#include "engine/core/check.h"

namespace pedicel::app {

namespace {

// A world has one thread; the pool shares the worlds out.
std::shared_ptr<const SteeredScene> with_one_thread(std::shared_ptr<const SteeredScene> scene) {
  if (scene->assets->scene.threads == 1) return scene;
  return scene->with({{"threads", "1"}});
}

std::vector<std::unique_ptr<SteeredRun>> make(const std::shared_ptr<const SteeredScene>& scene,
                                              int worlds) {
  if (worlds < 1) throw UsageError("worlds = " + std::to_string(worlds) + ": must be at least 1");
  std::vector<std::unique_ptr<SteeredRun>> runs;
  for (int w = 0; w < worlds; ++w) runs.push_back(std::make_unique<SteeredRun>(scene));
  return runs;
}

int cores(int wanted) {
  if (wanted > 0) return wanted;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

bool is_marked(std::span<const std::uint8_t> mask, int world) {
  return mask.empty() || mask[static_cast<std::size_t>(world)] != 0;
}

}  // namespace

SteeredWorlds::SteeredWorlds(std::shared_ptr<const SteeredScene> scene, int worlds, int threads)
    : runs_(make(with_one_thread(std::move(scene)), worlds)),
      state_(RowLayout(runs_.front()->simulation()), worlds),
      pool_(cores(threads)) {}

void SteeredWorlds::fill() {
  pool_.for_each(size(), [&](int w) { fill(w); });
}

void SteeredWorlds::step(long steps, std::span<const std::uint8_t> mask,
                         const std::function<void(int)>& stepped) {
  // A world stays with its thread to the end: no waiting for each other, warm caches.
  pool_.for_each(size(), [&](int w) {
    if (!is_marked(mask, w)) return;
    for (long i = 0; i < steps; ++i) {
      if (!run(w).step()) break;
      if (stepped) stepped(w);
    }
    fill(w);
  });
}

void SteeredWorlds::reset(std::span<const std::uint8_t> mask) {
  std::mutex mutex;
  std::exception_ptr fault;
  pool_.for_each(size(), [&](int w) {
    if (!is_marked(mask, w)) return;
    // A task of the pool must not throw.
    try {
      run(w).reset();
      fill(w);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!fault) fault = std::current_exception();
    }
  });
  if (fault) std::rethrow_exception(fault);
}

}  // namespace pedicel::app
