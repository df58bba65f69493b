#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

namespace pedicel {

/// A place in a text file; line and column count from 1, 0 means "the file as a whole".
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

enum class Severity { warning, error };

class InvalidFile;

struct Diagnostic {
  Severity severity = Severity::error;
  SourcePosition where;
  std::string what;  ///< what is wrong, and what was expected
};

/// "file:line:column: error: what"
std::string to_string(const Diagnostic& diagnostic);
/// Those, one line each.
std::string lines_of(const std::vector<Diagnostic>& diagnostics);
/// "file:line:column: what", one line each, for what says by itself that it failed.
std::string sentences(const std::vector<Diagnostic>& diagnostics);

/// Collects what is wrong with a file, so that a reader can report every fault at once. Readers
/// take one of these, add to it, and return nothing when it holds an error: nothing half loaded.
class Diagnostics {
 public:
  void error(SourcePosition where, std::string what);
  void warning(SourcePosition where, std::string what);
  /// Takes over what a reader below threw, places and all.
  void add(const InvalidFile& fault);

  bool has_errors() const { return errors_ > 0; }
  int error_count() const { return errors_; }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// One line per problem.
  std::string text() const;

 private:
  std::vector<Diagnostic> all_;
  int errors_ = 0;
};

/// Thrown by a reader that cannot go on, or by callers that need a file whole; exit code 3.
class InvalidFile : public std::runtime_error {
 public:
  explicit InvalidFile(const Diagnostics& diagnostics);
  InvalidFile(SourcePosition where, std::string what);

  const std::vector<Diagnostic>& all() const { return all_; }

 private:
  std::vector<Diagnostic> all_;
};

}  // namespace pedicel
