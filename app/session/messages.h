#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::app {

/// Something to tell the user.
struct Message {
  Severity severity = Severity::error;
  std::string text;  ///< one or more lines, "file:line:column: error: ..." where a file is meant
  std::string sentence;    ///< the same without the word, for what says by itself that it failed
  bool can_retry = false;  ///< SessionFiles::reload() reads the file again
  int times = 1;           ///< that it was said
};

/// What a session has told the user.
class Messages {
 public:
  void say(Severity severity, const std::string& text, bool can_retry = false);
  /// As one message.
  void say(const std::vector<Diagnostic>& problems, bool can_retry);
  /// One message each.
  void say_remarks(const Diagnostics& remarks);
  /// Something that may be read again there.
  void tell(const std::string& text) { say(Severity::notice, text); }

  /// The newest last, each text once. Faults of files go once the files can be read.
  const std::vector<Message>& all() const { return messages_; }
  /// How many there were since the start, those that have gone too.
  std::size_t said() const { return said_; }
  void clear() { messages_.clear(); }
  void forget_file_faults();

 private:
  void add(Message message);

  std::vector<Message> messages_;
  std::size_t said_ = 0;
};

}  // namespace pedicel::app
