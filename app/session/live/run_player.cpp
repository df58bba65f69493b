#include "pedicel/app/session/live/run_player.h"

#include <algorithm>

#include "pedicel/core/check.h"
#include "pedicel/core/timer.h"

namespace pedicel::app {

BuildNews RunPlayer::build(const MakeAssets& make, std::uint64_t document_hash, bool restart) {
  BuildNews news;
  news.document_hash = document_hash;
  const RunMode before = mode_;
  try {
    if (run_ == nullptr || restart) {
      mode_ = RunMode::building;
      publish(true);
    }
    const std::shared_ptr<const SceneAssets> assets = make();
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

void RunPlayer::take_assets(const std::shared_ptr<const SceneAssets>& assets, bool restart) {
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

}  // namespace pedicel::app
