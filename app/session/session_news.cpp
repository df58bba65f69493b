#include <algorithm>

#include "pedicel/app/session/document/scene_references.h"
#include "pedicel/app/session/measured/experiment_reading.h"
#include "pedicel/app/session/measured/measured_data.h"
#include "pedicel/app/session/session.h"

/// What the simulation's thread has to tell, and what becomes of edits that cannot be simulated.
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
    if (messages_[i].severity == Severity::error) result = {false, messages_[i].sentence};
  if (unbuilt_ && result.ok) result = {false, sentences(unbuilt_->problems)};
  return result;
}

void Session::update() {
  for (const BuildNews& news : control_.take_news()) take_news(news);
  std::erase_if(dropped_, [](const auto& one) { return one->has_ended(); });
  if (reading_ && reading_->has_ended()) finish_reading();
  tell_faults(measured_->update());
  tell_pick();
}

void Session::take_news(const BuildNews& news) {
  if (news.built) {
    built_ = true;
    if (failed_path_.empty()) forget_file_faults();
  } else if (news.document_hash == 0) {
    say(news.problems, false);  // of the run
  } else if (news.document_hash == hash_) {
    unbuilt_ = news;
    if (!gesture_ && !take_back_unbuilt()) say(news.problems, true);
  }
  if (!news.restarted) return;
  for (const std::string& one : news.notes) {
    const bool warns = one.find("warning:") != std::string::npos;
    say(warns ? Severity::warning : Severity::notice, one);
  }
}

// What cannot be simulated would leave the document and the run apart. A document that could not be
// built as it was opened is left to be mended instead.
bool Session::take_back_unbuilt() {
  if (!unbuilt_ || gesture_ || !built_ || !history_.can_undo()) return false;
  const History::Step& step = history_.last();
  const std::string why = summary_of(unbuilt_->problems);
  const std::string verb = step.commands.empty() ? "the change" : step.commands.back().verb();
  std::string hint;
  for (const std::string& name : broken_references(document_))
    hint += (hint.empty() ? ", expected \"clear references " : "\", \"clear references ") + name;
  if (!hint.empty()) hint += "\" before";
  forget_in_log(step.commands);
  const std::size_t steps = step.commands.size();
  take_back(history_.drop());
  for (std::size_t i = 0; i < steps; ++i) add_to_journal("undo");
  say(Severity::error, verb + ": taken back, for it could not be simulated: " + why + hint);
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

void Session::say(Severity severity, const std::string& text, bool can_retry) {
  add_message({severity, text, text, can_retry});
}

void Session::say(const std::vector<Diagnostic>& problems, bool can_retry) {
  add_message({Severity::error, lines_of(problems), sentences(problems), can_retry});
}

void Session::add_message(Message message) {
  const auto same = std::ranges::find(messages_, message.text, &Message::text);
  if (same != messages_.end()) {
    message.times = same->times + 1;
    const bool last = same + 1 == messages_.end();
    if (last && !message.can_retry) {
      same->times = message.times;
      return;
    }
    messages_.erase(same);
  }
  // Only the file that was tried last is read again.
  if (message.can_retry)
    for (Message& one : messages_) one.can_retry = false;
  ++said_;
  messages_.push_back(std::move(message));
}

}  // namespace pedicel::app
