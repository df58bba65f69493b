#pragma once

#include <memory>
#include <vector>

#include "app/session/live/live_run.h"
#include "app/session/live/snapshot.h"

namespace pedicel::app {

/// Copies what a picture needs out of a run, keeping what rarely changes (models, bodies, events)
/// for the next snapshot.
class SnapshotMaker {
 public:
  /// The simulation was built anew, or has gone back: nothing that is kept counts any more.
  void forget(bool new_stage);
  /// Constants changed: models are copied again.
  void forget_models() { models_.clear(); }

  /// Everything but mode, rates and errors.
  std::shared_ptr<Snapshot> make(const LiveRun& run);
  /// One that was made before, as the newest.
  std::shared_ptr<Snapshot> again(const Snapshot& before);

 private:
  void add_plants(const simulation::Simulation& simulation, Snapshot& snapshot);
  void add_strain(const simulation::Simulation& simulation, Snapshot& snapshot) const;
  void add_bodies(const simulation::Simulation& simulation, Snapshot& snapshot);
  void add_contacts(const simulation::Simulation& simulation, Snapshot& snapshot);
  void add_robot(const simulation::Simulation& simulation, Snapshot& snapshot) const;
  void add_events(const simulation::Simulation& simulation);

  std::uint64_t number_ = 0, stage_ = 0;
  std::vector<std::shared_ptr<const cosserat::RodModel>> models_;
  std::vector<std::shared_ptr<const BodyInfo>> bodies_;
  std::shared_ptr<const std::vector<std::string>> colliders_;
  std::shared_ptr<const std::vector<world::Event>> events_;
};

}  // namespace pedicel::app
