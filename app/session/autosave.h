#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/session/journal.h"
#include "app/session/messages.h"

namespace pedicel::app {

/// Where journals lie by default: $XDG_STATE_HOME/pedicel, else ~/.local/state/pedicel; empty where
/// there is neither.
std::filesystem::path autosave_folder();

/// The journal of a session, if it keeps one. Where it cannot be written any more that is said, and
/// there is none from then on.
class Autosave {
 public:
  /// `folder` of the journals; empty: none. `messages` must outlive it.
  Autosave(const std::filesystem::path& folder, Messages& messages);

  /// Begins anew with this document.
  void begin(const Document& document);
  /// A command that was done, and the document after it.
  void add(const std::string& line, const Document& document);
  /// Nothing is to be recovered: the journal goes.
  void close();

 private:
  std::unique_ptr<Journal> journal_;
  Messages& messages_;
};

}  // namespace pedicel::app
