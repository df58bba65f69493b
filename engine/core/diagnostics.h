#pragma once

#include <iosfwd>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pedicel {

/// A place in a text file; line and column count from 1, 0 means "the file as a whole".
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

enum class Severity { notice, warning, error };

class InvalidFile;

struct Diagnostic {
  Severity severity = Severity::error;
  SourcePosition where;
  std::string what;   ///< what is wrong, and what was expected
  int more = 0;       ///< how often the same is wrong further on
  int last_line = 0;  ///< where the last of those stands
};

/// Text from a file or from a caller, fit for a line of a terminal: control characters, line ends,
/// bytes that are no UTF-8 and marks that turn the direction of writing come as \xNN; what is
/// longer than `longest` bytes ends in "...".
std::string printable(std::string_view text, std::size_t longest = 1000);
/// The same in quotes and short, for a cell or a name within a sentence.
std::string in_quotes(std::string_view text);

/// "file:line:column: error: what", printable.
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
  /// What is worth knowing where nothing is wrong.
  void notice(SourcePosition where, std::string what);
  /// One of many alike (a fault in every row of a table): the first of a `kind` in a file is kept,
  /// the others are counted.
  void repeated_error(std::string_view kind, SourcePosition where, std::string what);
  /// Counts one more of a kind where a first one is there; false where there is none yet. For
  /// faults whose place takes time to find.
  bool again(std::string_view kind, const SourcePosition& where);
  /// Takes over what a reader below threw, places and all.
  void add(const InvalidFile& fault);

  bool has_errors() const { return errors_ > 0; }
  int error_count() const { return errors_; }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// One line per problem.
  std::string text() const;

 private:
  std::vector<Diagnostic> all_;
  std::map<std::string, std::size_t, std::less<>> kinds_;  ///< by kind and file: place in all_
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
