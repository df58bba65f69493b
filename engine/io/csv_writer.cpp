#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/check.h"
#include "io/atomic_file.h"
#include "io/csv.h"

namespace pedicel::io {

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) fail(error.message());
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) fail(std::strerror(errno));
  text_row(columns);
  if (const int failure = write_rows()) {
    ::close(file_);
    std::filesystem::remove(path, error);
    fail(std::strerror(failure));
  }
}

CsvWriter::~CsvWriter() {
  write_rows();
  ::close(file_);
}

void CsvWriter::row(std::span<const double> values) {
  PEDICEL_ASSERT(values.size() == columns_);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i) waiting_ += ',';
    waiting_ += format_number(values[i]);
  }
  waiting_ += '\n';
}

void CsvWriter::text_row(const std::vector<std::string>& cells) {
  PEDICEL_ASSERT(cells.size() == columns_);
  for (std::size_t i = 0; i < cells.size(); ++i) waiting_ += (i ? "," : "") + cells[i];
  waiting_ += '\n';
}

void CsvWriter::flush() {
  if (const int error = write_rows()) fail(std::strerror(error));
}

// In one go, so that one who is killed leaves whole rows; what fits only in part is taken back.
int CsvWriter::write_rows() {
  const std::string rows = std::exchange(waiting_, {});
  std::size_t done = 0;
  while (done < rows.size()) {
    const ssize_t n = ::write(file_, rows.data() + done, rows.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int error = n < 0 ? errno : ENOSPC;
      if (::ftruncate(file_, written_) != 0) return error;
      ::lseek(file_, written_, SEEK_SET);
      return error;
    }
    done += static_cast<std::size_t>(n);
  }
  written_ += static_cast<off_t>(rows.size());
  return 0;
}

void CsvWriter::fail(const std::string& reason) const {
  throw WriteError(path_.string() + ": cannot be written: " + reason);
}

}  // namespace pedicel::io
