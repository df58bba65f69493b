#include "app/session/live/live_run.h"

#include <algorithm>

namespace pedicel::app {

LiveRun::LiveRun(std::shared_ptr<const simulation::SceneAssets> assets)
    : first_(std::move(assets)) {
  make();
}

void LiveRun::make() {
  simulation_ = std::make_unique<simulation::Simulation>(first_);
  pull_ = std::make_unique<Pull>(*simulation_);
  simulation_->world().add(*pull_);
}

void LiveRun::act(Input input) {
  done_.resize(next_);
  known_steps_ = steps();
  done_.push_back({steps(), input});
  next_ = done_.size();
  input(*this);
}

const world::WorldReport& LiveRun::step() {
  while (next_ < done_.size() && done_[next_].step <= steps()) done_[next_++].input(*this);
  const world::WorldReport& report = simulation_->step();
  known_steps_ = std::max(known_steps_, steps());
  return report;
}

void LiveRun::rewind() {
  make();
  next_ = 0;
}

void LiveRun::reset() {
  first_ = simulation_->assets();
  done_.clear();
  known_steps_ = 0;
  rewind();
}

void LiveRun::change_to(std::shared_ptr<const simulation::SceneAssets> assets) {
  act([assets](LiveRun& run) {
    run.simulation_->change_to(assets);
    run.pull_->renew();
  });
}

}  // namespace pedicel::app
