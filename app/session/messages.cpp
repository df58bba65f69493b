#include "app/session/messages.h"

#include <algorithm>

namespace pedicel::app {

void Messages::say(Severity severity, const std::string& text, bool can_retry) {
  add({severity, text, text, can_retry});
}

void Messages::say(const std::vector<Diagnostic>& problems, bool can_retry) {
  add({Severity::error, lines_of(problems), sentences(problems), can_retry});
}

void Messages::say_remarks(const Diagnostics& remarks) {
  for (const Diagnostic& one : remarks.all()) say(one.severity, to_string(one));
}

void Messages::forget_file_faults() {
  std::erase_if(messages_, [](const Message& one) { return one.can_retry; });
}

void Messages::add(Message message) {
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
