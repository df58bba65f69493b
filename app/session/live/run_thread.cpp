#include "pedicel/app/session/live/run_thread.h"

#include <algorithm>

#include "pedicel/core/check.h"
#include "pedicel/core/stop.h"
#include "pedicel/core/timer.h"

namespace pedicel::app {

using std::chrono::steady_clock;

namespace {

/// A simulation that has fallen back by more than this no longer tries to catch up.
constexpr std::chrono::milliseconds most_behind{100};

}  // namespace

RunThread::RunThread() : snapshot_(std::make_shared<const Snapshot>()) {
  thread_ = std::thread([this] { loop(); });
}

RunThread::~RunThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void RunThread::ask(Request request) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back(std::move(request));
  }
  wake_.notify_all();
}

void RunThread::ask_build(Build build) {
  {
    const std::lock_guard lock(mutex_);
    build.restart = build.restart || (build_ && build_->restart);
    build_ = std::move(build);
  }
  wake_.notify_all();
}

void RunThread::wait() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return requests_.empty() && !build_ && !busy_ && !working_; });
}

std::shared_ptr<const Snapshot> RunThread::snapshot() {
  taken_ = true;
  const std::lock_guard lock(snapshot_mutex_);
  return snapshot_;
}

std::vector<BuildNews> RunThread::take_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, {});
}

void RunThread::loop() {
  while (true) {
    if (take_request()) continue;
    {
      std::unique_lock lock(mutex_);
      working_ = has_steps();
      idle_.notify_all();
      wait_for_work(lock);
      if (stop_) return;
      if (!requests_.empty() || build_) continue;
    }
    if (stop_requested) {
      pause();
      continue;
    }
    if (is_held() || (to_do_ == 0 && mode_ != RunMode::playing)) continue;
    if (to_do_ == 0 && !held_ && speed_ > 0.0 && steady_clock::now() < due()) continue;
    one_step();
  }
}

// Builds first: what was asked for after an edit is meant for what was edited.
bool RunThread::take_request() {
  Request request;
  std::optional<Build> build;
  {
    const std::lock_guard lock(mutex_);
    if (stop_ || (requests_.empty() && !build_)) {
      busy_ = false;
      return false;
    }
    busy_ = true;
    if (build_) {
      build = std::exchange(build_, std::nullopt);
    } else {
      request = std::move(requests_.front());
      requests_.pop_front();
    }
  }
  if (build)
    do_build(std::move(*build));
  else
    guarded(request);
  const std::lock_guard lock(mutex_);
  working_ = has_steps();
  return true;
}

// What cannot be done is told; the thread lives on.
void RunThread::guarded(const Request& request) {
  try {
    request(*this);
  } catch (const std::exception& fault) {
    BuildNews news;
    news.problems.push_back({Severity::error, {}, fault.what()});
    const std::lock_guard lock(mutex_);
    news_.push_back(std::move(news));
  }
}

bool RunThread::is_held() const {
  constexpr double slack = 1e-9;  // s
  return held_ && run_ && run_->simulation().world().time() >= *held_ - slack;
}

bool RunThread::has_steps() const {
  return !is_held() && (to_do_ > 0 || (held_ && mode_ == RunMode::playing));
}

bool RunThread::has_work() const {
  return stop_ || !requests_.empty() || build_ || has_steps();
}

void RunThread::wait_for_work(std::unique_lock<std::mutex>& lock) {
  const auto ready = [this] { return has_work(); };
  if (mode_ != RunMode::playing || is_held())
    wake_.wait(lock, ready);
  else if (speed_ > 0.0)
    wake_.wait_until(lock, due(), ready);
}

steady_clock::time_point RunThread::due() const {
  const double ahead = run_->simulation().world().time() - clock_time_;
  return clock_start_ + std::chrono::duration_cast<steady_clock::duration>(
                            std::chrono::duration<double>(ahead / speed_));
}

void RunThread::start_clock() {
  clock_start_ = steady_clock::now();
  clock_time_ = run_ ? run_->simulation().world().time() : 0.0;
}

double RunThread::building_for() const {
  const steady_clock::duration since(building_since_.load());
  if (since.count() == 0) return 0.0;
  return std::chrono::duration<double>(steady_clock::now().time_since_epoch() - since).count();
}

void RunThread::do_build(Build build) {
  building_since_ = steady_clock::now().time_since_epoch().count();
  BuildNews news;
  news.document_hash = build.document_hash;
  const RunMode before = mode_;
  try {
    if (run_ == nullptr || build.restart) {
      mode_ = RunMode::building;
      publish(true);
    }
    const std::shared_ptr<const SceneAssets> assets = build.make();
    news.restarted = build.restart || !run_ || !run_->simulation().can_change_to(*assets);
    mode_ = before == RunMode::empty ? RunMode::paused : before;
    take_assets(assets, news.restarted);
    document_hash_ = build.document_hash;
    news.built = true;
    news.notes = assets->notes;
  } catch (const InvalidFile& fault) {
    mode_ = before;
    news.problems = fault.all();
  } catch (const std::exception& fault) {
    mode_ = before;
    news.problems.push_back({Severity::error, {}, fault.what()});
  }
  building_since_ = 0;
  publish(true);
  const std::lock_guard lock(mutex_);
  news_.push_back(std::move(news));
}

void RunThread::take_assets(const std::shared_ptr<const SceneAssets>& assets, bool restart) {
  if (!restart) {
    run()->change_to(assets);
    kept_.clear();
    maker_.forget_models();
    return;
  }
  auto run = std::make_unique<LiveRun>(assets);  // may throw: the one that runs goes on then
  run_ = std::move(run);
  kept_.clear();
  shown_.reset();
  maker_.forget(true);
  log.begin(run_->simulation());
  if (mode_ == RunMode::unstable) mode_ = RunMode::paused;
  error_.clear();
  rates_ = RunRates{};
  start_clock();
}

void RunThread::play() {
  if (!run_ || mode_ == RunMode::unstable || !run()) return;
  mode_ = RunMode::playing;
  to_do_ = 0;
  start_clock();
  publish(true);
}

void RunThread::pause() {
  to_do_ = 0;
  if (mode_ == RunMode::playing) mode_ = RunMode::paused;
  rates_.rest();
  publish(true);
}

void RunThread::advance(long steps) {
  if (!run_ || mode_ == RunMode::unstable || steps <= 0) return;
  if (shown_ && show(*shown_ + steps)) return;
  if (!run()) return;
  mode_ = RunMode::paused;
  to_do_ += steps;
}

void RunThread::reset() {
  if (!run_) return;
  to_do_ = 0;
  kept_.clear();
  shown_.reset();
  run_->reset();
  maker_.forget(false);
  log.begin(run_->simulation());
  error_.clear();
  if (mode_ == RunMode::unstable) mode_ = RunMode::paused;
  start_clock();
  publish(true);
}

void RunThread::set_speed(double speed) {
  speed_ = std::max(0.0, speed);
  start_clock();
  publish(true);
}

void RunThread::hold_at(std::optional<double> time) {
  held_ = time;
  start_clock();
}

void RunThread::act(LiveRun::Input input) {
  if (!run()) return;
  run_->act(std::move(input));
  keep_anew();
  if (mode_ != RunMode::playing) publish(true);
}

void RunThread::one_step() {
  const double before = run_->simulation().world().time();
  const Timer timer;
  run_->step();
  rates_.step(timer.seconds(), run_->simulation().world().dt());
  log.observe(run_->simulation());
  if (keeps_steps()) keep_step();
  if (to_do_ > 0) --to_do_;
  if (speed_ > 0.0 && steady_clock::now() > due() + most_behind) start_clock();
  if (run_->unstable()) {
    last_good_time_ = before;
    check_stability();
  }
  publish(is_held() || (to_do_ == 0 && mode_ != RunMode::playing));
}

}  // namespace pedicel::app
