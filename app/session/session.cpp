#include "pedicel/app/session/session.h"

#include <cstdlib>
#include <map>

#include "pedicel/app/session/commands/command_table.h"
#include "pedicel/app/session/journal.h"
#include "pedicel/app/session/measured/experiment_reading.h"
#include "pedicel/app/session/measured/measured_data.h"
#include "pedicel/core/check.h"
#include "pedicel/io/atomic_file.h"

namespace pedicel::app {

namespace {

/// A script may be played from another folder.
Command with_whole_path(const Command& command) {
  if (command.verb() != "play trajectory") return command;
  const auto file = std::filesystem::absolute(command.word("file")).lexically_normal();
  std::map<std::string, Value> arguments{{"file", file.string()}};
  if (command.has("loop")) arguments.emplace("loop", command.number("loop"));
  return Command(command.verb(), std::move(arguments));
}

}  // namespace

Session::Session(const SessionOptions& options)
    : options_(options), measured_(std::make_unique<MeasuredData>()) {
  if (!options.autosave.empty()) journal_ = std::make_unique<Journal>(options.autosave);
  set_document(empty_document());
}

// What was neither saved nor given up is offered again, as after a kill.
Session::~Session() {
  end_gesture();
  if (journal_ && !dirty()) journal_->close();
}

void Session::set_document(Document document) {
  gesture_.reset();
  history_.clear();
  log_.clear();
  document_ = std::move(document);
  saved_hash_ = document_.state_hash();
  saved_settings_.clear();
  first_ = document_;
  saved_.reset();
  files_.remember(document_);
  built_ = false;
  begin_journal();
  rebuild(true);
}

void Session::rebuild(bool restart) {
  hash_ = document_.state_hash();
  unbuilt_.reset();
  control_.build(
      [document = document_, packages = options_.packages] {
        return std::make_shared<const SceneAssets>(scene_of(document),
                                                   options_of(document, packages));
      },
      hash_, restart);
}

bool Session::dirty() const {
  return hash_ != saved_hash_;
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
    return change_document(description->complete ? description->complete(*this, command) : command);
  Result result = handle(*this, command);
  if (!result.ok || description->scope != Scope::run) return result;
  // Of a dragged tool the last place counts.
  if (command.verb() == "tool" && !log_.empty() && log_.back().starts_with("tool "))
    log_.back() = command.text();
  else
    log_.push_back(with_whole_path(command).text());
  return result;
}

Result Session::change_document(const Command& command) {
  const bool merges = gesture_ && !gesture_->commands.empty() &&
                      gesture_->commands.back().merge_key() == command.merge_key();
  const Document before = merges ? gesture_->before_last : document_;
  Document changed = before;
  apply_command(changed, command);
  document_ = std::move(changed);
  if (!gesture_) {
    record({{command}, before, document_});
  } else {
    if (merges) gesture_->commands.pop_back();
    gesture_->commands.push_back(command);
    gesture_->before_last = before;
  }
  rebuild();
  return {};
}

void Session::record(History::Step step) {
  for (const Command& command : step.commands) note(command.text());
  history_.add(std::move(step));
}

void Session::begin_journal() {
  if (!journal_) return;
  try {
    journal_->begin(document_);
  } catch (const io::WriteError& fault) {
    say(Severity::warning, std::string("autosave is off: ") + fault.what());
    journal_.reset();
  }
}

void Session::note(const std::string& line) {
  log_.push_back(line);
  add_to_journal(line);
}

// Read back, each command of a gesture is a step by itself.
void Session::note_step(const std::string& verb, const History::Step& step) {
  for (std::size_t i = 0; i < step.commands.size(); ++i) note(verb);
}

void Session::add_to_journal(const std::string& line) {
  if (!journal_) return;
  try {
    journal_->add(line, document_.state_hash());
  } catch (const io::WriteError& fault) {
    say(Severity::warning, std::string("autosave is off: ") + fault.what());
    journal_.reset();
  }
}

void Session::begin_gesture() {
  end_gesture();
  gesture_ = Gesture{document_, document_, {}};
}

void Session::end_gesture() {
  if (!gesture_) return;
  Gesture gesture = std::move(*gesture_);
  gesture_.reset();
  if (gesture.commands.empty()) return;
  record({std::move(gesture.commands), std::move(gesture.before), document_});
  take_back_unbuilt();
}

void Session::cancel_gesture() {
  if (!gesture_) return;
  document_ = std::move(gesture_->before);
  gesture_.reset();
  rebuild();
}

// Another state of the document. Where plants are saved is no part of what is undone.
void Session::take_back(const Document& document) {
  const Document now = std::move(document_);
  document_ = document;
  document_.path = now.path;
  for (DocumentPlant& one : document_.plants) {
    const int index = now.plant_index(one.entry.name);
    if (index < 0) continue;
    one.entry.file = now.plants[index].entry.file;
    one.entry.source = now.plants[index].entry.source;
  }
  rebuild();
}

Result Session::undo() {
  end_gesture();
  if (Result pull = undo_pull(); pull.ok) return finish(std::move(pull));
  if (!history_.can_undo()) return {false, "nothing to undo"};
  const std::string name = history_.undo_name();
  const History::Step& step = history_.last();
  take_back(history_.undo());
  note_step("undo", step);
  return finish({true, name});
}

Result Session::redo() {
  end_gesture();
  if (!history_.can_redo()) return {false, "nothing to redo"};
  const std::string name = history_.redo_name();
  take_back(history_.redo());
  note_step("redo", history_.last());
  return finish({true, name});
}

std::filesystem::path autosave_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state)
    return std::filesystem::path(state) / "pedicel";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".local" / "state" / "pedicel";
  return {};
}

}  // namespace pedicel::app
