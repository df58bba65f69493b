#include "app/session/run_edits.h"

namespace pedicel::app {

void RunEdits::add(const std::string& what, const Snapshot& now, std::size_t edits,
                   bool by_command) {
  std::erase_if(edits_,
                [&](const Edit& one) { return one.stage != now.stage || one.step > now.step; });
  edits_.push_back({what, now.stage, now.step, edits, by_command});
}

// In another simulation, or at an earlier time, there is nothing left of it. A later edit of the
// document goes first. A cut is there from the step at which it was made.
bool RunEdits::has(const Snapshot& now, std::size_t edits) const {
  if (edits_.empty() || edits_.back().stage != now.stage || edits > edits_.back().edits)
    return false;
  const Edit& last = edits_.back();
  return last.step < now.step || (last.step == now.step && (last.what == "cut" || now.pull.active));
}

RunEdits::Edit RunEdits::take() {
  const Edit last = edits_.back();
  edits_.pop_back();
  return last;
}

}  // namespace pedicel::app
