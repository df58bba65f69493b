#include "pedicel/app/session/pull_history.h"

namespace pedicel::app {

void PullHistory::add(const Snapshot& now, std::size_t edits, bool by_command) {
  std::erase_if(pulls_,
                [&](const Pull& one) { return one.stage != now.stage || one.step > now.step; });
  pulls_.push_back({now.stage, now.step, edits, by_command});
}

// In another simulation, or at an earlier time, there is nothing left of it. A later edit goes
// first.
bool PullHistory::has(const Snapshot& now, std::size_t edits) const {
  return !pulls_.empty() && pulls_.back().stage == now.stage &&
         (pulls_.back().step < now.step || now.pull.active) && edits <= pulls_.back().edits;
}

PullHistory::Pull PullHistory::take() {
  const Pull last = pulls_.back();
  pulls_.pop_back();
  return last;
}

}  // namespace pedicel::app
