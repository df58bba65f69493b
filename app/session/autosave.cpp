#include "app/session/autosave.h"

#include <cstdlib>

#include "engine/io/atomic_file.h"

namespace pedicel::app {

std::filesystem::path autosave_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state)
    return std::filesystem::path(state) / "pedicel";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".local" / "state" / "pedicel";
  return {};
}

Autosave::Autosave(const std::filesystem::path& folder, Messages& messages) : messages_(messages) {
  if (!folder.empty()) journal_ = std::make_unique<Journal>(folder);
}

void Autosave::begin(const Document& document) {
  if (!journal_) return;
  try {
    journal_->begin(document);
  } catch (const io::WriteError& fault) {
    messages_.say(Severity::warning, std::string("autosave is off: ") + fault.what());
    journal_.reset();
  }
}

void Autosave::add(const std::string& line, const Document& document) {
  if (!journal_) return;
  try {
    journal_->add(line, document.state_hash());
  } catch (const io::WriteError& fault) {
    messages_.say(Severity::warning, std::string("autosave is off: ") + fault.what());
    journal_.reset();
  }
}

void Autosave::close() {
  if (journal_) journal_->close();
}

}  // namespace pedicel::app
