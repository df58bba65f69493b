#include "engine/core/diagnostics.h"

#include <utility>

namespace pedicel {

namespace {

// With what parts it from the rest of a line.
std::string place(const SourcePosition& where) {
  if (where.file.empty()) return "";
  const std::string file = printable(where.file);
  if (where.line == 0) return file + ": ";
  return file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": ";
}

// A text of several lines is one of ours, what stands in a file is quoted in it.
std::string printable_lines(std::string_view text) {
  std::string out;
  while (true) {
    const std::size_t end = text.find('\n');
    out += printable(text.substr(0, end));
    if (end == std::string_view::npos) return out;
    out += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string sentence(const Diagnostic& diagnostic) {
  std::string text = printable_lines(diagnostic.what);
  if (diagnostic.more > 0)
    text += " (and " + std::to_string(diagnostic.more) + " more like it, the last in line " +
            std::to_string(diagnostic.last_line) + ")";
  return text;
}

std::string kind_key(std::string_view kind, const SourcePosition& where) {
  return where.file + '\n' + std::string(kind);
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  const char* severity = diagnostic.severity == Severity::error     ? "error: "
                         : diagnostic.severity == Severity::warning ? "warning: "
                                                                    : "notice: ";
  return place(diagnostic.where) + severity + sentence(diagnostic);
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
    text += (text.empty() ? "" : "\n") + place(diagnostic.where) + sentence(diagnostic);
  return text;
}

void Diagnostics::error(SourcePosition where, std::string what) {
  all_.push_back({Severity::error, std::move(where), std::move(what)});
  ++errors_;
}

void Diagnostics::warning(SourcePosition where, std::string what) {
  all_.push_back({Severity::warning, std::move(where), std::move(what)});
}

void Diagnostics::notice(SourcePosition where, std::string what) {
  all_.push_back({Severity::notice, std::move(where), std::move(what)});
}

void Diagnostics::repeated_error(std::string_view kind, SourcePosition where, std::string what) {
  if (again(kind, where)) return;
  kinds_.emplace(kind_key(kind, where), all_.size());
  error(std::move(where), std::move(what));
}

bool Diagnostics::again(std::string_view kind, const SourcePosition& where) {
  const auto known = kinds_.find(kind_key(kind, where));
  if (known == kinds_.end()) return false;
  ++all_[known->second].more;
  all_[known->second].last_line = where.line;
  return true;
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
