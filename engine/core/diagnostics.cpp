#include "core/diagnostics.h"

#include <utility>

namespace pedicel {

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.where.file;
  if (diagnostic.where.line > 0) {
    text += ":" + std::to_string(diagnostic.where.line);
    text += ":" + std::to_string(diagnostic.where.column);
  }
  text += diagnostic.severity == Severity::error ? ": error: " : ": warning: ";
  return text + diagnostic.what;
}

void Diagnostics::error(SourcePosition where, std::string what) {
  all_.push_back({Severity::error, std::move(where), std::move(what)});
  ++errors_;
}

void Diagnostics::warning(SourcePosition where, std::string what) {
  all_.push_back({Severity::warning, std::move(where), std::move(what)});
}

std::string Diagnostics::text() const {
  std::string text;
  for (const Diagnostic& diagnostic : all_) {
    if (!text.empty()) text += '\n';
    text += to_string(diagnostic);
  }
  return text;
}

InvalidFile::InvalidFile(const Diagnostics& diagnostics) : std::runtime_error(diagnostics.text()) {}

InvalidFile::InvalidFile(SourcePosition where, std::string what)
    : std::runtime_error(to_string({Severity::error, std::move(where), std::move(what)})) {}

}  // namespace pedicel
