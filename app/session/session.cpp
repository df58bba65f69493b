#include "session/session.h"

#include <algorithm>
#include <cstdlib>

#include "core/check.h"
#include "io/atomic_file.h"
#include "session/command_table.h"
#include "session/experiment_reading.h"
#include "session/journal.h"
#include "session/measured_data.h"

namespace pedicel::app {

namespace {

std::string text_of(const std::vector<Diagnostic>& problems) {
  std::string text;
  for (const Diagnostic& one : problems)
    text += (text.empty() ? "" : "\n") + (one.where.file.empty() ? one.what : to_string(one));
  return text;
}

/// The first of them, and how many more there are, in one line.
std::string summary_of(const std::vector<Diagnostic>& problems) {
  if (problems.empty()) return "no reason given";
  const Diagnostic& first = problems.front();
  std::string text = first.what;
  if (!first.where.file.empty())
    text += " (" + first.where.file + ":" + std::to_string(first.where.line) + ")";
  if (problems.size() > 1) text += ", and " + std::to_string(problems.size() - 1) + " more";
  return text;
}

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
    result = {false, fault.what(), true};
  } catch (const io::WriteError& fault) {
    result = {false, fault.what()};
  }
  return finish(std::move(result));
}

Result Session::run_text(const std::string& line) {
  Diagnostics diagnostics;
  const auto command = parse_command(line, {"command", 1, 1}, diagnostics);
  if (!command) return {false, diagnostics.text()};
  return run(*command);
}

// Where commands wait, a build that failed is the fault of the command that asked for it.
Result Session::finish(Result result) {
  if (!options_.waits) return result;
  const std::size_t before = said_;
  std::uint64_t built = 0;
  do {
    built = hash_;
    control_.wait();
    update();
  } while (hash_ != built);
  const std::size_t news = std::min(said_ - before, messages_.size());
  for (std::size_t i = messages_.size() - news; i < messages_.size() && result.ok; ++i)
    if (messages_[i].severity == Severity::error) result = {false, messages_[i].text};
  if (unbuilt_ && result.ok) result = {false, text_of(unbuilt_->problems)};
  return result;
}

Result Session::dispatch(const Command& command) {
  const CommandDescription* description = find_command(command.verb());
  if (!description) throw UsageError("no such command");
  if (description->scope == Scope::document) return change_document(command);
  Result result =
      description->scope == Scope::session ? session_command(command) : run_command(command);
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

void Session::update() {
  for (const BuildNews& news : control_.take_news()) take_news(news);
  std::erase_if(dropped_, [](const auto& one) { return one->has_ended(); });
  if (reading_ && reading_->has_ended()) finish_reading();
  tell_faults(measured_->update());
}

void Session::take_news(const BuildNews& news) {
  if (news.built) {
    built_ = true;
    if (failed_path_.empty()) forget_file_faults();
  } else if (news.document_hash == 0) {
    say(Severity::error, text_of(news.problems));  // of the run
  } else if (news.document_hash == hash_) {
    unbuilt_ = news;
    if (!gesture_ && !take_back_unbuilt()) say(Severity::error, text_of(news.problems), true);
  }
  if (!news.restarted) return;
  for (const std::string& one : news.notes) say(Severity::warning, one);
}

// What cannot be simulated would leave the document and the run apart. A document that could not be
// built as it was opened is left to be mended instead.
bool Session::take_back_unbuilt() {
  if (!unbuilt_ || gesture_ || !built_ || !history_.can_undo()) return false;
  const History::Step& step = history_.last();
  const std::string why = summary_of(unbuilt_->problems);
  const std::string verb = step.commands.empty() ? "the change" : step.commands.back().verb();
  forget_in_log(step.commands);
  const std::size_t steps = step.commands.size();
  take_back(history_.drop());
  for (std::size_t i = 0; i < steps; ++i) add_to_journal("undo");
  say(Severity::error, verb + ": taken back, for it could not be simulated: " + why);
  return true;
}

// As if they had not been done. Where something was undone since, that is said as one more undo.
void Session::forget_in_log(const std::vector<Command>& commands) {
  std::vector<std::string> kept = log_;
  for (auto command = commands.rbegin(); command != commands.rend(); ++command) {
    const auto found = std::find(kept.rbegin(), kept.rend(), command->text());
    const auto is_history = [](const std::string& line) {
      return line == "undo" || line == "redo";
    };
    if (found == kept.rend() || std::any_of(kept.rbegin(), found, is_history)) {
      log_.push_back("undo");
      return;
    }
    kept.erase(std::next(found).base());
  }
  log_ = std::move(kept);
}

void Session::forget_file_faults() {
  std::erase_if(messages_, [](const Message& one) { return one.can_retry; });
}

void Session::say(Severity severity, std::string text, bool can_retry) {
  if (!messages_.empty() && messages_.back().text == text) return;
  ++said_;
  messages_.push_back({severity, std::move(text), can_retry});
}

std::filesystem::path autosave_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state)
    return std::filesystem::path(state) / "pedicel";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".local" / "state" / "pedicel";
  return {};
}

}  // namespace pedicel::app
