#include "app/session/session.h"

#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/live/pull.h"
#include "app/session/session_files.h"
#include "app/session/session_films.h"
#include "app/session/session_measured.h"
#include "app/session/session_recovery.h"
#include "app/session/session_robot.h"
#include "app/session/session_tuning.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

Session::Session(const SessionOptions& options)
    : core_(options),
      files_(std::make_unique<SessionFiles>(*this, core_)),
      films_(std::make_unique<SessionFilms>(core_)),
      measured_(std::make_unique<SessionMeasured>(*this, core_)),
      recovery_(std::make_unique<SessionRecovery>(*this, core_)),
      robot_(std::make_unique<SessionRobot>(core_)),
      tuning_(std::make_unique<SessionTuning>(*this, core_)) {
  files_->begin(empty_document());
}

// What was neither saved nor given up is offered again, as after a kill.
Session::~Session() {
  end_gesture();
  if (!files_->dirty()) core_.autosave.close();
}

Result Session::run(const Command& command) {
  Result result;
  try {
    result = dispatch(command);
  } catch (const UsageError& fault) {
    result = {false, command.verb() + ": " + fault.what()};
  } catch (const InvalidFile& fault) {
    result = {false, sentences(fault.all()), true};
  } catch (const io::WriteError& fault) {
    result = {false, fault.what()};
  }
  return finish(std::move(result));
}

Result Session::run_text(const std::string& line) {
  Diagnostics diagnostics;
  const auto command = parse_command(line, {"command", 1, 1}, diagnostics);
  if (!command) return {false, sentences(diagnostics.all())};
  return run(*command);
}

Result Session::dispatch(const Command& command) {
  const CommandDescription* description = find_command(command.verb());
  if (!description) throw UsageError("no such command");
  const CommandHandler::OnSession handle = description->handler.on_session();
  if (!handle)
    return core_.editor.change(description->complete ? description->complete(*this, command)
                                                     : command);
  check_arguments(*description, command);
  Result result = handle(*this, command);
  if (result.ok && description->scope == Scope::run) core_.editor.log().add_run(command);
  return result;
}

// Where commands wait, a build that failed is the fault of the command that asked for it.
Result Session::finish(Result result) {
  if (!core_.options.waits) return result;
  const std::size_t before = core_.messages.said();
  std::uint64_t built = 0;
  do {
    built = core_.editor.hash();
    core_.control.wait();
    update();
  } while (core_.editor.hash() != built);
  const std::vector<Message>& all = core_.messages.all();
  const std::size_t news = std::min(core_.messages.said() - before, all.size());
  for (std::size_t i = all.size() - news; i < all.size() && result.ok; ++i)
    if (all[i].severity == Severity::error) result = {false, all[i].sentence};
  if (core_.editor.unbuilt() && result.ok)
    result = {false, sentences(core_.editor.unbuilt()->problems)};
  return result;
}

void Session::update() {
  for (const BuildNews& news : core_.control.take_news()) {
    if (news.built && !files_->has_failed()) core_.messages.forget_file_faults();
    core_.editor.take_news(news);
  }
  measured_->update();
  robot_->update();
}

void Session::begin_pull(const PullPlace& place, const Vec3& target_W, bool by_command) {
  core_.run_edits.add("pull", *snapshot(), history().size(), by_command);
  core_.control.begin_pull(place, target_W);
}

void Session::cut(const std::string& organ, double at) {
  core_.run_edits.add("cut", *snapshot(), history().size(), true);
  core_.control.cut(organ, at);
}

bool Session::can_undo() const {
  return history().can_undo() || core_.run_edits.has(*snapshot(), history().size());
}

Result Session::undo() {
  end_gesture();
  if (core_.run_edits.has(*snapshot(), history().size())) {
    const RunEdits::Edit edit = core_.run_edits.take();
    core_.control.take_back_to(edit.step);
    // Of a pull by hand the log says nothing, so it says nothing of its end either.
    if (edit.by_command) core_.editor.log().add("undo");
    return finish({true, edit.what});
  }
  if (!history().can_undo()) return {false, "nothing to undo"};
  return finish(core_.editor.undo());
}

Result Session::redo() {
  end_gesture();
  if (!history().can_redo()) return {false, "nothing to redo"};
  return finish(core_.editor.redo());
}

}  // namespace pedicel::app
