#include "app/session/live/run_thread.h"

#include "engine/core/check.h"
#include "engine/core/stop.h"

namespace pedicel::app {

using std::chrono::steady_clock;

RunThread::RunThread() {
  thread_ = std::thread([this] { loop(); });
}

RunThread::~RunThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    player_.stop_replay();
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

std::vector<BuildNews> RunThread::take_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, {});
}

void RunThread::loop() {
  while (true) {
    if (take_request()) continue;
    {
      std::unique_lock lock(mutex_);
      working_ = player_.has_steps();
      idle_.notify_all();
      wait_for_work(lock);
      if (stop_) return;
      if (!requests_.empty() || build_) continue;
    }
    if (stop_requested)
      player_.pause();
    else
      step_if_due();
  }
}

void RunThread::step_if_due() {
  if (player_.is_at_rest()) return;
  const auto due = player_.due();
  if (!due || steady_clock::now() >= *due) player_.step();
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
    do_build(*build);
  else
    guarded(request);
  const std::lock_guard lock(mutex_);
  working_ = player_.has_steps();
  return true;
}

// What cannot be done is told; the thread lives on.
void RunThread::guarded(const Request& request) {
  try {
    request(player_);
  } catch (const std::exception& fault) {
    BuildNews news;
    news.problems.push_back({Severity::error, {}, fault.what()});
    tell(std::move(news));
  }
}

void RunThread::tell(BuildNews news) {
  const std::lock_guard lock(mutex_);
  news_.push_back(std::move(news));
}

bool RunThread::has_work() const {
  return stop_ || !requests_.empty() || build_ || player_.has_steps();
}

void RunThread::wait_for_work(std::unique_lock<std::mutex>& lock) {
  const auto ready = [this] { return has_work(); };
  if (player_.is_at_rest())
    wake_.wait(lock, ready);
  else if (const auto due = player_.due())
    wake_.wait_until(lock, *due, ready);
}

double RunThread::building_for() const {
  const steady_clock::duration since(building_since_.load());
  if (since.count() == 0) return 0.0;
  return std::chrono::duration<double>(steady_clock::now().time_since_epoch() - since).count();
}

void RunThread::do_build(const Build& build) {
  building_since_ = steady_clock::now().time_since_epoch().count();
  BuildNews news = player_.build(build.make, build.document_hash, build.restart);
  building_since_ = 0;
  player_.publish(true);
  tell(std::move(news));
}

}  // namespace pedicel::app
