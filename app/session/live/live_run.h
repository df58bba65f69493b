#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/session/live/pull.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

/// A simulation and everything that was done to it, so that any of its steps can be had again, bit
/// by bit: what acts on it (a pull, a robot's goal, another stiffness) is kept with the number of
/// the step before which it was done, and a step back is a run from time 0 with all of that. Bullet
/// keeps history in many places (warm starting, contact points, sleeping pairs), so a run from the
/// start is the one way that is right.
class LiveRun {
 public:
  explicit LiveRun(std::shared_ptr<const simulation::SceneAssets> assets);

  simulation::Simulation& simulation() { return *simulation_; }
  const simulation::Simulation& simulation() const { return *simulation_; }
  Pull& pull() { return *pull_; }
  const Pull& pull() const { return *pull_; }
  long steps() const { return simulation_->world().steps(); }

  /// Does something now, and again at this step of every replay. What was done after this step is
  /// forgotten.
  using Input = std::function<void(LiveRun&)>;
  void act(Input input);
  /// One step; what was done to the run at its number is done again.
  const world::WorldReport& step();
  /// To the beginning; what was done stays known.
  void rewind();
  /// Forgets what was done, and goes to the beginning.
  void reset();

  bool unstable() const { return simulation_->world().report().errors & world::fatal_errors; }
  /// Goes on with other constants, from the next step on; it must be able to.
  void change_to(std::shared_ptr<const simulation::SceneAssets> assets);

 private:
  struct Done {
    long step = 0;
    Input input;
  };
  void make();

  std::shared_ptr<const simulation::SceneAssets> first_;  // what the run started with
  std::unique_ptr<simulation::Simulation> simulation_;
  std::unique_ptr<Pull> pull_;  // of simulation_; outlives no step of it
  std::vector<Done> done_;
  std::size_t next_ = 0;  // of done_, to do again
};

}  // namespace pedicel::app
