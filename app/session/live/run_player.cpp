#include "app/session/live/run_player.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/core/timer.h"

namespace pedicel::app {

namespace {

/// Between snapshots of a replay.
constexpr std::chrono::milliseconds replay_frame{100};

/// Elements of a run that keeps its steps while it plays, too: with more, that would take a tenth
/// of a step.
constexpr int most_elements_kept = 600;

}  // namespace

BuildNews RunPlayer::build(const MakeAssets& make, std::uint64_t document_hash, bool restart) {
  BuildNews news;
  news.document_hash = document_hash;
  const RunMode before = mode_;
  try {
    if (run_ == nullptr || restart) {
      mode_ = RunMode::building;
      publish(true);
    }
    const std::shared_ptr<const simulation::SceneAssets> assets = make();
    news.restarted = restart || !run_ || !run_->simulation().can_change_to(*assets);
    mode_ = before == RunMode::empty ? RunMode::paused : before;
    take_assets(assets, news.restarted);
    document_hash_ = document_hash;
    news.built = true;
    news.notes = assets->notes;
  } catch (const InvalidFile& fault) {
    mode_ = before;
    news.problems = fault.all();
  } catch (const std::exception& fault) {
    mode_ = before;
    news.problems.push_back({Severity::error, {}, fault.what()});
  }
  return news;
}

void RunPlayer::take_assets(const std::shared_ptr<const simulation::SceneAssets>& assets,
                            bool restart) {
  if (!restart) {
    run()->change_to(assets);
    kept_.clear();
    maker_.forget_models();
    return;
  }
  auto run = std::make_unique<LiveRun>(assets);  // may throw: the one that runs goes on then
  run_ = std::move(run);
  maker_.forget(true);
  rates_ = RunRates{};
  begin_anew();
}

void RunPlayer::begin_anew() {
  kept_.clear();
  shown_.reset();
  log.begin(run_->simulation());
  if (mode_ == RunMode::unstable) mode_ = RunMode::paused;
  clock_.start(time());
}

void RunPlayer::play() {
  if (!run_ || mode_ == RunMode::unstable || !run()) return;
  mode_ = RunMode::playing;
  to_do_ = 0;
  clock_.start(time());
  publish(true);
}

void RunPlayer::pause() {
  to_do_ = 0;
  if (mode_ == RunMode::playing) mode_ = RunMode::paused;
  rates_.rest();
  publish(true);
}

void RunPlayer::advance(long steps) {
  if (!run_ || mode_ == RunMode::unstable || steps <= 0) return;
  if (shown_ && show(*shown_ + steps)) return;
  if (!run()) return;
  mode_ = RunMode::paused;
  to_do_ += steps;
}

void RunPlayer::reset() {
  if (!run_) return;
  to_do_ = 0;
  run_->reset();
  maker_.forget(false);
  begin_anew();
  publish(true);
}

void RunPlayer::set_speed(double speed) {
  clock_.set_speed(std::max(0.0, speed));
  clock_.start(time());
  publish(true);
}

void RunPlayer::hold_at(std::optional<double> time_held) {
  clock_.hold_at(time_held);
  clock_.start(time());
}

// What acts on the run from its present step on makes that step and those after it others.
void RunPlayer::act(LiveRun::Input input) {
  if (!run()) return;
  run_->act(std::move(input));
  kept_.drop_from(run_->steps());
  if (!kept_.empty()) keep_step();
  if (mode_ != RunMode::playing) publish(true);
}

bool RunPlayer::has_steps() const {
  return !is_held() && (to_do_ > 0 || (clock_.holds() && mode_ == RunMode::playing));
}

std::optional<RunClock::Wall::time_point> RunPlayer::due() const {
  if (to_do_ > 0 || clock_.holds() || clock_.speed() == 0.0) return {};
  return clock_.due(time());
}

void RunPlayer::step() {
  const double before = time();
  const Timer timer;
  run_->step();
  rates_.step(timer.seconds(), run_->simulation().world().dt());
  log.observe(run_->simulation());
  if (keeps_steps()) keep_step();
  if (to_do_ > 0) --to_do_;
  clock_.let_go_of_delay(time());
  if (run_->unstable()) {
    instability_ = instability_of(run_->simulation(), before);
    mode_ = RunMode::unstable;
    to_do_ = 0;
    rates_.rest();
  }
  publish(is_at_rest());
}

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
