#include "pedicel/app/session/live/run_thread.h"
#include "pedicel/io/csv.h"

/// What the simulation's thread tells the others.
namespace pedicel::app {

using std::chrono::steady_clock;

namespace {

/// Between snapshots, and between those that nobody looks at.
constexpr std::chrono::milliseconds frame{16}, idle_frame{100};

}  // namespace

// The organ of the worst error, and why; the window stays open and everything else works.
void RunThread::check_stability() {
  const world::StepReport& report = run_->simulation().world().report();
  mode_ = RunMode::unstable;
  to_do_ = 0;
  culprit_ = report.culprit;
  culprit_plant_ = culprit_element_ = -1;
  for (int p = 0; p < run_->simulation().rods().size(); ++p) {
    const cosserat::StepReport& own = run_->simulation().rods().report(p);
    if (own.errors == 0 || own.element < 0 || culprit_plant_ >= 0) continue;
    culprit_plant_ = p;
    culprit_element_ = own.element;
    const cosserat::RodModel& model = run_->simulation().rods().model(p);
    if (culprit_.empty()) culprit_ = model.organs[model.elements[own.element].organ];
  }
  error_ = "unstable at " + io::format_number(report.time, 6) +
           " s: " + (culprit_.empty() ? "" : culprit_ + ": ") +
           world::remedy(static_cast<world::StepError>(report.errors & world::fatal_errors));
  rates_.rest();
}

void RunThread::publish(bool now) {
  const bool wanted = steady_clock::now() - last_publish_ > (taken_ ? frame : idle_frame);
  if (!now && !wanted) return;
  if (!run_) {
    auto snapshot = std::make_shared<Snapshot>();
    fill_state(*snapshot);
    return hand_over(std::move(snapshot));
  }
  std::shared_ptr<Snapshot> snapshot;
  if (shown_)
    snapshot = maker_.again(*kept_[static_cast<std::size_t>(*shown_ - kept_.front()->step)]);
  else
    snapshot = maker_.make(*run_);
  fill_state(*snapshot);
  hand_over(std::move(snapshot));
}

void RunThread::fill_state(Snapshot& snapshot) const {
  snapshot.mode = to_do_ > 0 && mode_ == RunMode::paused ? RunMode::playing : mode_;
  snapshot.document_hash = document_hash_;
  snapshot.speed = speed_;
  snapshot.real_time_factor = rates_.real_time_factor();
  snapshot.ms_per_step = rates_.ms_p50();
  snapshot.ms_per_step_p95 = rates_.ms_p95();
  snapshot.steps_per_second = rates_.steps_per_second();
  snapshot.snapshots_per_second = rates_.snapshots_per_second();
  snapshot.replay_share = replay_share_;
  if (mode_ != RunMode::unstable) return;
  snapshot.error = error_;
  snapshot.culprit = culprit_;
  snapshot.culprit_plant = culprit_plant_;
  snapshot.culprit_element = culprit_element_;
  snapshot.last_good_time = last_good_time_;
}

void RunThread::hand_over(std::shared_ptr<Snapshot> snapshot) {
  last_publish_ = steady_clock::now();
  rates_.snapshot();
  taken_ = false;
  std::shared_ptr<const Snapshot> old;
  const std::lock_guard lock(snapshot_mutex_);
  old = std::exchange(snapshot_, std::move(snapshot));
}

}  // namespace pedicel::app
