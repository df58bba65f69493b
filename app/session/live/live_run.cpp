#include "app/session/live/live_run.h"

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
  done_.push_back({steps(), input});
  next_ = done_.size();
  input(*this);
}

const world::WorldReport& LiveRun::step() {
  while (next_ < done_.size() && done_[next_].step <= steps()) done_[next_++].input(*this);
  return simulation_->step();
}

void LiveRun::rewind() {
  make();
  next_ = 0;
}

void LiveRun::reset() {
  first_ = simulation_->assets();
  done_.clear();
  rewind();
}

void LiveRun::change_to(std::shared_ptr<const simulation::SceneAssets> assets) {
  act([assets](LiveRun& run) {
    run.simulation_->change_to(assets);
    run.pull_->renew();
  });
}

}  // namespace pedicel::app
