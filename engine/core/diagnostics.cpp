#include "core/diagnostics.h"

#include <utility>

namespace pedicel {

namespace {

// With what parts it from the rest of a line.
std::string place(const SourcePosition& where) {
  if (where.file.empty()) return "";
  if (where.line == 0) return where.file + ": ";
  return where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": ";
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  const char* severity = diagnostic.severity == Severity::error ? "error: " : "warning: ";
  return place(diagnostic.where) + severity + diagnostic.what;
}

std::string lines_of(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics)
    text += (text.empty() ? "" : "\n") + to_string(diagnostic);
  return text;
}

std::string sentences(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics)
    text += (text.empty() ? "" : "\n") + place(diagnostic.where) + diagnostic.what;
  return text;
}

void Diagnostics::error(SourcePosition where, std::string what) {
  all_.push_back({Severity::error, std::move(where), std::move(what)});
  ++errors_;
}

void Diagnostics::warning(SourcePosition where, std::string what) {
  all_.push_back({Severity::warning, std::move(where), std::move(what)});
}

std::string Diagnostics::text() const {
  return lines_of(all_);
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
