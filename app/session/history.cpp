#include "app/session/history.h"

#include "engine/core/check.h"

namespace pedicel::app {

namespace {

std::string name_of(const History::Step& step) {
  return step.commands.empty() ? "" : step.commands.back().verb();
}

}  // namespace

void History::add(Step step) {
  steps_.resize(position_);
  steps_.push_back(std::move(step));
  ++position_;
}

void History::clear() {
  steps_.clear();
  position_ = 0;
}

std::string History::undo_name() const {
  return can_undo() ? name_of(steps_[position_ - 1]) : "";
}

std::string History::redo_name() const {
  return can_redo() ? name_of(steps_[position_]) : "";
}

const Document& History::undo() {
  PEDICEL_ASSERT(can_undo());
  return steps_[--position_].before;
}

Document History::drop() {
  PEDICEL_ASSERT(can_undo());
  Document before = std::move(steps_[--position_].before);
  steps_.resize(position_);
  return before;
}

const Document& History::redo() {
  PEDICEL_ASSERT(can_redo());
  return steps_[position_++].after;
}

}  // namespace pedicel::app
