#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pedicel::app {

class Session;
struct SessionCore;

/// A document that a killed program left.
struct LostDocument {
  std::filesystem::path file;      ///< the journal
  std::filesystem::path document;  ///< that was open; empty: a new one
  int commands = 0;
  std::string when;  ///< UTC
};

/// Brings back what a killed program left.
class SessionRecovery {
 public:
  SessionRecovery(Session& session, SessionCore& core) : session_(session), core_(core) {}

  /// The newest first. Empty without autosave.
  std::vector<LostDocument> lost_documents() const;
  /// Opens it and does its commands again.
  bool recover(const LostDocument& lost);
  void forget(const LostDocument& lost);

 private:
  Session& session_;
  SessionCore& core_;
};

}  // namespace pedicel::app
