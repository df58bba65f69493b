#include "app/session/document_editor.h"

#include "app/session/commands/command_table.h"
#include "app/session/document/scene_references.h"

namespace pedicel::app {

namespace {

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

}  // namespace

DocumentEditor::DocumentEditor(const std::vector<std::string>& packages, RunControl& control,
                               Autosave& autosave, Messages& messages)
    : packages_(packages), control_(control), autosave_(autosave), messages_(messages) {}

void DocumentEditor::open(Document document) {
  gesture_.reset();
  history_.clear();
  log_.clear();
  document_ = std::move(document);
  built_ = false;
  rebuild(true);
}

void DocumentEditor::reload(Document fresh, const Command& command) {
  const Document before = document_;
  gesture_.reset();
  document_ = std::move(fresh);
  history_.add({{command}, before, document_});
  log_.add(command.text());
  built_ = false;
  rebuild(true);
}

void DocumentEditor::rebuild(bool restart) {
  hash_ = document_.state_hash();
  unbuilt_.reset();
  control_.build(
      [document = document_, packages = packages_] {
        return std::make_shared<const simulation::SceneAssets>(scene_of(document),
                                                               options_of(document, packages));
      },
      hash_, restart);
}

Result DocumentEditor::change(const Command& command) {
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

void DocumentEditor::record(History::Step step) {
  for (const Command& command : step.commands) note(command.text());
  history_.add(std::move(step));
}

void DocumentEditor::note(const std::string& line) {
  log_.add(line);
  autosave_.add(line, document_);
}

// Read back, each command of a gesture is a step by itself.
void DocumentEditor::note_step(const std::string& verb, const History::Step& step) {
  for (std::size_t i = 0; i < step.commands.size(); ++i) note(verb);
}

void DocumentEditor::begin_gesture() {
  end_gesture();
  gesture_ = Gesture{document_, document_, {}};
}

void DocumentEditor::end_gesture() {
  if (!gesture_) return;
  Gesture gesture = std::move(*gesture_);
  gesture_.reset();
  if (gesture.commands.empty()) return;
  record({std::move(gesture.commands), std::move(gesture.before), document_});
  take_back_unbuilt();
}

void DocumentEditor::cancel_gesture() {
  if (!gesture_) return;
  document_ = std::move(gesture_->before);
  gesture_.reset();
  rebuild();
}

// Another state of the document. Where plants are saved is no part of what is undone.
void DocumentEditor::take_back(const Document& document) {
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

Result DocumentEditor::undo() {
  const std::string name = history_.undo_name();
  const History::Step& step = history_.last();
  take_back(history_.undo());
  note_step("undo", step);
  return {true, name};
}

Result DocumentEditor::redo() {
  const std::string name = history_.redo_name();
  take_back(history_.redo());
  note_step("redo", history_.last());
  return {true, name};
}

void DocumentEditor::take_news(const BuildNews& news) {
  if (news.built) {
    built_ = true;
  } else if (news.document_hash == 0) {
    messages_.say(news.problems, false);  // of the run
  } else if (news.document_hash == hash_) {
    unbuilt_ = news;
    if (!gesture_ && !take_back_unbuilt()) messages_.say(news.problems, true);
  }
  if (!news.restarted) return;
  for (const std::string& one : news.notes) {
    const bool warns = one.find("warning:") != std::string::npos;
    messages_.say(warns ? Severity::warning : Severity::notice, one);
  }
}

// What cannot be simulated would leave the document and the run apart. A document that could not be
// built as it was opened is left to be mended instead.
bool DocumentEditor::take_back_unbuilt() {
  if (!unbuilt_ || gesture_ || !built_ || !history_.can_undo()) return false;
  const History::Step& step = history_.last();
  const std::string why = summary_of(unbuilt_->problems);
  const std::string verb = step.commands.empty() ? "the change" : step.commands.back().verb();
  std::string hint;
  for (const std::string& name : broken_references(document_))
    hint += (hint.empty() ? ", expected \"clear references " : "\", \"clear references ") + name;
  if (!hint.empty()) hint += "\" before";
  log_.forget(step.commands);
  const std::size_t steps = step.commands.size();
  take_back(history_.drop());
  for (std::size_t i = 0; i < steps; ++i) autosave_.add("undo", document_);
  messages_.say(Severity::error,
                verb + ": taken back, for it could not be simulated: " + why + hint);
  return true;
}

}  // namespace pedicel::app
