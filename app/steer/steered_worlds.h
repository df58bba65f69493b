#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/steer/steered_run.h"
#include "engine/core/thread_pool.h"

namespace pedicel::app {

/// Many independent runs of one scene, stepped at once on all cores.
class SteeredWorlds {
 public:
  /// `threads` 0: all cores. Throws UsageError for fewer than one world.
  SteeredWorlds(std::shared_ptr<const SteeredScene> scene, int worlds, int threads);

  int size() const { return static_cast<int>(runs_.size()); }
  SteeredRun& run(int world) { return *runs_[static_cast<std::size_t>(world)]; }
  StateArrays& state() { return state_; }
  int threads() const { return pool_.threads(); }

  /// So many steps in every world whose mark is not 0 (empty: in all); one that fails does no more.
  /// `stepped` is called with the world after each of its steps, on the thread that does them.
  void step(long steps, std::span<const std::uint8_t> mask,
            const std::function<void(int)>& stepped = {});
  /// Worlds whose mark is not 0 (empty: all) begin anew.
  void reset(std::span<const std::uint8_t> mask);
  /// Writes the state of all worlds.
  void fill();

 private:
  void fill(int world) { state_.fill(run(world).simulation(), world); }

  std::vector<std::unique_ptr<SteeredRun>> runs_;
  StateArrays state_;
  ThreadPool pool_;
};

}  // namespace pedicel::app
