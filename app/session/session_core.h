#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/session/autosave.h"
#include "app/session/document_editor.h"
#include "app/session/live/run_control.h"
#include "app/session/messages.h"
#include "app/session/run_edits.h"

namespace pedicel::app {

struct SessionOptions {
  std::vector<std::string> packages;  ///< "NAME=PATH"
  std::filesystem::path autosave;     ///< folder of the journals; empty: none
  /// Every command waits until the simulation has done it (scripts, tests): then what it finds
  /// wrong is the command's own fault, too.
  bool waits = false;
};

/// What all parts of a session work on: the document, the run, the messages. The session has it,
/// and it outlives the parts.
struct SessionCore {
  explicit SessionCore(const SessionOptions& about)
      : options(about),
        autosave(options.autosave, messages),
        editor(options.packages, control, autosave, messages) {}

  SessionOptions options;
  Messages messages;
  RunControl control;
  Autosave autosave;
  DocumentEditor editor;
  RunEdits run_edits;
};

}  // namespace pedicel::app
