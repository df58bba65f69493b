#include "engine/io/output_check.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/io/atomic_file.h"

namespace pedicel::io {

namespace fs = std::filesystem;

const char* const other_run_writes = "another run is writing there, expected another name";

namespace {

[[noreturn]] void fail_there(const fs::path& path, const std::string& what) {
  throw WriteError(path.string() + ": " + what);
}

[[noreturn]] void fail_with(const fs::path& path, int code) {
  fail_there(path, std::string("cannot be written: ") + std::strerror(code));
}

/// What is there; a reason other than that nothing is ends it.
fs::file_status status_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status there = fs::status(path, error);
  if (error && there.type() != fs::file_type::not_found) fail_with(path, error.value());
  return there;
}

/// The folder itself, or the one that is there of those above.
fs::path nearest_there(const fs::path& path) {
  fs::path folder = fs::absolute(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  while (folder.has_relative_path() && !fs::exists(status_of(folder)))
    folder = folder.parent_path();
  return folder;
}

/// Rights are not all that counts (a read-only disk, a folder of the kernel's): it is tried.
void try_to_write(const fs::path& folder, const fs::path& path) {
  std::string probe = (folder / ".pedicel-tryXXXXXX").string();
  const int file = ::mkostemp(probe.data(), O_CLOEXEC);
  if (file < 0) fail_with(path, errno);
  const char byte = 0;
  const int code = ::write(file, &byte, 1) == 1 ? 0 : errno;
  ::close(file);
  ::unlink(probe.c_str());
  if (code != 0) fail_with(path, code);
}

/// Some file systems have no locks; then nobody else has one either.
bool is_taken_by_another(int file) {
  return ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace

void check_place_for_files(const fs::path& folder) {
  try_to_write(nearest_there(folder), folder);
}

void check_output_file(const fs::path& path) {
  const fs::file_status there = status_of(path);
  if (fs::is_directory(there) || !path.has_filename())
    fail_there(path, "is a folder, expected a file's name");
  if (fs::exists(there) && !fs::is_regular_file(there))
    fail_there(path, "is a device or a pipe, expected a plain file, or none yet");
  try_to_write(nearest_there(fs::absolute(path).parent_path()), path);
  if (!fs::exists(there)) return;
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) fail_with(path, errno);
  const bool taken = is_taken_by_another(file);
  ::close(file);
  if (taken) fail_there(path, other_run_writes);
}

FolderLock::FolderLock(const fs::path& folder) {
  file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file_ < 0) fail_with(folder, errno);
  if (!is_taken_by_another(file_)) return;
  ::close(file_);
  fail_there(folder, other_run_writes);
}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace pedicel::io
