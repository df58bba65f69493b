#include <cerrno>
#include <cstring>

#include "pedicel/core/check.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/csv.h"

namespace pedicel::io {

namespace {

/// A full disk takes a row in part: the rows before it stay, and an empty file goes.
void keep_whole_rows(const std::filesystem::path& path) {
  std::error_code error;
  std::string text;
  if (!std::filesystem::is_regular_file(path, error)) return;
  try {
    text = read_file(path);
  } catch (const InvalidFile&) {
    return;
  }
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos)
    std::filesystem::remove(path, error);
  else
    std::filesystem::resize_file(path, end + 1, error);
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw WriteError(path.string() + ": cannot be written: " + error.message());
  file_.open(path, std::ios::trunc);
  if (!file_) throw WriteError(path.string() + ": cannot be written: " + std::strerror(errno));
  text_row(columns);
  flush();
}

void CsvWriter::row(std::span<const double> values) {
  std::vector<std::string> cells;
  for (const double value : values) cells.push_back(format_number(value));
  text_row(cells);
}

// In one piece, which goes to the file in one piece: who is killed leaves whole rows.
void CsvWriter::text_row(const std::vector<std::string>& cells) {
  PEDICEL_ASSERT(cells.size() == columns_);
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) row += (i ? "," : "") + cells[i];
  file_ << row + '\n';
}

void CsvWriter::flush() {
  if (file_.flush()) return;
  const std::string reason = std::strerror(errno);
  file_.close();
  keep_whole_rows(path_);
  throw WriteError(path_.string() + ": cannot be written: " + reason);
}

}  // namespace pedicel::io
