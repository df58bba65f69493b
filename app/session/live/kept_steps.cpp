#include "app/session/live/kept_steps.h"

#include "engine/core/check.h"

namespace pedicel::app {

void KeptSteps::add(std::shared_ptr<const Snapshot> step) {
  if (!steps_.empty() && steps_.back()->step + 1 != step->step) steps_.clear();
  steps_.push_back(std::move(step));
  if (steps_.size() > static_cast<std::size_t>(most)) steps_.pop_front();
}

void KeptSteps::drop_from(long step) {
  while (!steps_.empty() && steps_.back()->step >= step) steps_.pop_back();
}

bool KeptSteps::has(long step) const {
  return !steps_.empty() && step >= steps_.front()->step && step <= steps_.back()->step;
}

const Snapshot& KeptSteps::at(long step) const {
  PEDICEL_ASSERT(has(step));
  return *steps_[static_cast<std::size_t>(step - steps_.front()->step)];
}

}  // namespace pedicel::app
