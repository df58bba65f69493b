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

void Diagnostics::add(const InvalidFile& fault) {
  for (const Diagnostic& diagnostic : fault.all()) {
    all_.push_back(diagnostic);
    if (diagnostic.severity == Severity::error) ++errors_;
  }
}

InvalidFile::InvalidFile(const Diagnostics& diagnostics)
    : std::runtime_error(diagnostics.text()), all_(diagnostics.all()) {}

InvalidFile::InvalidFile(SourcePosition where, std::string what)
    : std::runtime_error(to_string({Severity::error, where, what})),
      all_{{Severity::error, where, what}} {}

}  // namespace pedicel
