#include <algorithm>

#include "pedicel/app/session/live/run_player.h"
#include "pedicel/core/stop.h"

/// Going back: steps that are kept are shown again, for others the run is done anew. And what is
/// handed over of the step that is shown.
namespace pedicel::app {

namespace {

/// Between snapshots of a replay.
constexpr std::chrono::milliseconds replay_frame{100};

/// Elements of a run that keeps its steps while it plays, too: with more, that would take a tenth
/// of a step.
constexpr int most_elements_kept = 600;

}  // namespace

void RunPlayer::go_to(long step) {
  if (!run_) return;
  step = std::max(0l, step);
  to_do_ = 0;
  if (show(step)) return;
  if (step > position()) return advance(step - position());
  replay_to(step);
}

LiveRun* RunPlayer::run() {
  if (shown_) replay_to(*shown_);
  return run_.get();
}

// Shows a step that is kept; false: none is.
bool RunPlayer::show(long step) {
  if (!kept_.has(step)) return false;
  shown_.reset();
  if (step != run_->steps()) shown_ = step;
  mode_ = RunMode::paused;
  rates_.rest();
  publish(true);
  return true;
}

bool RunPlayer::keeps_steps() const {
  if (to_do_ > 0 && to_do_ <= KeptSteps::most) return true;
  int elements = 0;
  const cosserat::RodSystem& rods = run_->simulation().rods();
  for (int p = 0; p < rods.size(); ++p) elements += rods.model(p).size();
  return elements <= most_elements_kept;
}

void RunPlayer::replay_to(long step) {
  to_do_ = 0;
  shown_.reset();
  kept_.clear();
  mode_ = RunMode::replaying;
  run_->rewind();
  maker_.forget(false);
  log.begin(run_->simulation());
  if (step < KeptSteps::most) keep_step();
  while (run_->steps() < step && !stopping_ && !stop_requested) {
    run_->step();
    log.observe(run_->simulation());
    if (run_->steps() + KeptSteps::most > step) keep_step();
    replay_share_ = static_cast<double>(run_->steps()) / static_cast<double>(step);
    if (snapshots.is_older_than(replay_frame)) publish(true);
  }
  mode_ = RunMode::paused;
  rates_.rest();
  publish(true);
}

void RunPlayer::publish(bool now) {
  if (!now && !snapshots.wants_another()) return;
  std::shared_ptr<Snapshot> newest = snapshot();
  fill_state(*newest);
  rates_.snapshot();
  snapshots.put(std::move(newest));
}

std::shared_ptr<Snapshot> RunPlayer::snapshot() {
  if (!run_) return std::make_shared<Snapshot>();
  return shown_ ? maker_.again(kept_.at(*shown_)) : maker_.make(*run_);
}

void RunPlayer::fill_state(Snapshot& snapshot) const {
  snapshot.mode = to_do_ > 0 && mode_ == RunMode::paused ? RunMode::playing : mode_;
  snapshot.document_hash = document_hash_;
  snapshot.speed = clock_.speed();
  snapshot.real_time_factor = rates_.real_time_factor();
  snapshot.ms_per_step = rates_.ms_p50();
  snapshot.ms_per_step_p95 = rates_.ms_p95();
  snapshot.steps_per_second = rates_.steps_per_second();
  snapshot.snapshots_per_second = rates_.snapshots_per_second();
  snapshot.replay_share = replay_share_;
  if (mode_ != RunMode::unstable) return;
  snapshot.error = instability_.error;
  snapshot.culprit = instability_.culprit;
  snapshot.culprit_plant = instability_.plant;
  snapshot.culprit_element = instability_.element;
  snapshot.last_good_time = instability_.last_good_time;
}

}  // namespace pedicel::app
