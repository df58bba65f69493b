#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/session/autosave.h"
#include "app/session/command_log.h"
#include "app/session/history.h"
#include "app/session/live/run_control.h"
#include "app/session/messages.h"
#include "app/session/result.h"

namespace pedicel::app {

/// The document that is open, what was done to it, and the simulation that is built of it. Each
/// change is built anew beside; one that cannot be is taken back as a whole once that is known.
class DocumentEditor {
 public:
  /// `packages`: "NAME=PATH", of robots. All of these must outlive it.
  DocumentEditor(const std::vector<std::string>& packages, RunControl& control, Autosave& autosave,
                 Messages& messages);

  const Document& document() const { return document_; }
  std::uint64_t hash() const { return hash_; }  ///< of the document
  const History& history() const { return history_; }
  CommandLog& log() { return log_; }
  const CommandLog& log() const { return log_; }

  /// Another document: what was done before is forgotten.
  void open(Document document);
  /// The document as its files say it now, as one step of the history.
  void reload(Document fresh, const Command& command);
  /// Where things are saved, which is no step: all else is as it was.
  void set_files(Document document) { document_ = std::move(document); }

  /// Does a document command: all of it or, with a UsageError, nothing.
  Result change(const Command& command);
  void begin_gesture();
  void end_gesture();
  void cancel_gesture();
  /// There must be such a step; see history().
  Result undo();
  Result redo();
  void forget_history() { history_.clear(); }

  /// What the simulation's thread has to tell.
  void take_news(const BuildNews& news);
  /// Why the document of now cannot be built; nothing: it can, or that is not known yet.
  const std::optional<BuildNews>& unbuilt() const { return unbuilt_; }

 private:
  struct Gesture {
    Document before;       // the gesture
    Document before_last;  // its last command
    std::vector<Command> commands;
  };
  void rebuild(bool restart = false);
  void take_back(const Document& document);
  bool take_back_unbuilt();
  void record(History::Step step);
  void note(const std::string& line);
  void note_step(const std::string& verb, const History::Step& step);

  const std::vector<std::string>& packages_;
  RunControl& control_;
  Autosave& autosave_;
  Messages& messages_;
  Document document_;
  std::uint64_t hash_ = 0;
  History history_;
  std::optional<Gesture> gesture_;
  CommandLog log_;
  bool built_ = false;  // something of this document
  std::optional<BuildNews> unbuilt_;
};

}  // namespace pedicel::app
