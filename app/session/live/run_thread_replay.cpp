#include <algorithm>

#include "pedicel/app/session/live/run_thread.h"
#include "pedicel/core/stop.h"

/// Going back: steps that are kept are shown again, for others the run is done anew.
namespace pedicel::app {

using std::chrono::steady_clock;

namespace {

/// Between snapshots of a replay.
constexpr std::chrono::milliseconds replay_frame{100};

}  // namespace

void RunThread::go_to(long step) {
  if (!run_) return;
  step = std::max(0l, step);
  to_do_ = 0;
  if (show(step)) return;
  if (step > position()) return advance(step - position());
  replay_to(step);
}

LiveRun* RunThread::run() {
  if (shown_) replay_to(*shown_);
  return run_.get();
}

// Shows a step that is kept; false: none is.
bool RunThread::show(long step) {
  if (kept_.empty() || step < kept_.front()->step || step > kept_.back()->step) return false;
  shown_.reset();
  if (step != run_->steps()) shown_ = step;
  mode_ = RunMode::paused;
  error_.clear();
  rates_.rest();
  publish(true);
  return true;
}

bool RunThread::keeps_steps() const {
  if (to_do_ > 0 && to_do_ <= most_kept) return true;
  int elements = 0;
  const cosserat::RodSystem& rods = run_->simulation().rods();
  for (int p = 0; p < rods.size(); ++p) elements += rods.model(p).size();
  return elements <= most_elements_kept;
}

// What acts on the run from its present step on makes that step and those after it others.
void RunThread::keep_anew() {
  while (!kept_.empty() && kept_.back()->step >= run_->steps()) kept_.pop_back();
  if (!kept_.empty()) keep_step();
}

void RunThread::keep_step() {
  if (!kept_.empty() && kept_.back()->step + 1 != run_->steps()) kept_.clear();
  kept_.push_back(maker_.make(*run_));
  if (kept_.size() > static_cast<std::size_t>(most_kept)) kept_.pop_front();
}

void RunThread::replay_to(long step) {
  to_do_ = 0;
  shown_.reset();
  kept_.clear();
  mode_ = RunMode::replaying;
  run_->rewind();
  maker_.forget(false);
  log.begin(run_->simulation());
  if (step < most_kept) keep_step();
  while (run_->steps() < step && !stopping_ && !stop_requested) {
    run_->step();
    log.observe(run_->simulation());
    if (run_->steps() + most_kept > step) keep_step();
    replay_share_ = static_cast<double>(run_->steps()) / static_cast<double>(step);
    if (steady_clock::now() - last_publish_ > replay_frame) publish(true);
  }
  mode_ = RunMode::paused;
  error_.clear();
  rates_.rest();
  publish(true);
}

}  // namespace pedicel::app
