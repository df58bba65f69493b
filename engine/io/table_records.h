#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace pedicel::io {

/// A cell of a table, without the blanks and quotes around it.
struct TableCell {
  std::string_view text;
  int column = 1;  ///< of its first character in its line, from 1; bytes
};

/// Cuts a text into records: lines, but for line ends within quotes. Line ends are LF, CR LF or CR.
class RecordScanner {
 public:
  explicit RecordScanner(std::string_view text) : rest_(text) {}

  /// The next record, blank lines included; false at the end.
  bool next();
  std::string_view record() const { return record_; }
  int line() const { return line_; }               ///< where it begins, from 1
  bool open_quote() const { return open_quote_; }  ///< its quote is never closed
  /// Goes back by the last record, which next() gives again.
  void again();
  int next_line() const { return next_line_; }
  /// What comes behind the record.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_, record_, before_;
  int line_ = 0, next_line_ = 1;
  bool open_quote_ = false;
};

/// Cuts records into cells. `separator` ' ' stands for any number of blanks. Cells live until the
/// next call.
class CellSplitter {
 public:
  explicit CellSplitter(char separator) : separator_(separator) {}

  const std::vector<TableCell>& split(std::string_view record);
  char separator() const { return separator_; }

 private:
  void split_blanks(std::string_view record);
  void split_quoted(std::string_view record);
  void add(std::string_view raw, std::size_t start);

  char separator_;
  std::vector<TableCell> cells_;
  std::deque<std::string> unquoted_;  ///< cells whose quotes are doubled
};

/// Nothing in it but blanks.
bool is_blank(std::string_view record);
/// Begins with '#', '%' or "//", but is no missing value (#N/A).
bool is_comment(std::string_view record);
/// "; words": where names are still to come, that is no row of two cells.
bool is_comment_above_header(std::string_view record);
/// What parts the header of a table drawn with | from its rows: |---|:--:|
bool is_rule(std::string_view record);

}  // namespace pedicel::io
