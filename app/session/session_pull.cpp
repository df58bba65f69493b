#include "pedicel/app/session/session.h"

/// Pulls, which undo takes back as it takes back edits: whichever came last.
namespace pedicel::app {

void Session::begin_pull(const PullPlace& place, const Vec3& target_W, bool by_command) {
  note_pull(by_command);
  control_.begin_pull(place, target_W);
}

void Session::note_pull(bool by_command) {
  const auto now = snapshot();
  std::erase_if(pulls_,
                [&](const Pulled& one) { return one.stage != now->stage || one.step > now->step; });
  pulls_.push_back({now->stage, now->step, history_.size(), by_command});
}

// In another simulation, or at an earlier time, there is nothing left of it. A later edit goes
// first.
bool Session::has_pull() const {
  const auto now = snapshot();
  return !pulls_.empty() && pulls_.back().stage == now->stage &&
         (pulls_.back().step < now->step || now->pull.active) &&
         history_.size() <= pulls_.back().history;
}

bool Session::can_undo() const {
  return history_.can_undo() || has_pull();
}

Result Session::undo_pull() {
  if (!has_pull()) return {false, "nothing to undo"};
  const Pulled pulled = pulls_.back();
  pulls_.pop_back();
  control_.take_back_to(pulled.step);
  // Of a pull by hand the log says nothing, so it says nothing of its end either.
  if (pulled.by_command) log_.push_back("undo");
  return {true, "pull"};
}

}  // namespace pedicel::app
