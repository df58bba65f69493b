#pragma once

#include <string>
#include <vector>

#include "app/session/document/document_parameters.h"
#include "app/session/result.h"

namespace pedicel::app {

class Session;
struct SessionCore;

/// Described numbers that may be changed while the plant moves.
class SessionTuning {
 public:
  SessionTuning(Session& session, SessionCore& core) : session_(session), core_(core) {}

  std::vector<SessionParameter> parameters() const;
  /// Sets a parameter back to what the files say.
  Result reset(const std::string& key);
  /// Writes changed plant parameters into the plants themselves, so that saving keeps them.
  Result keep();
  /// Sets all parameters back.
  Result discard();

 private:
  Session& session_;
  SessionCore& core_;
};

}  // namespace pedicel::app
