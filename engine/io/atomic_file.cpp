#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "core/diagnostics.h"

namespace pedicel::io {

namespace {

/// Bytes. What a program of this kind reads as text is far below; a disk image given by mistake is
/// not.
constexpr std::size_t largest_file = std::size_t{256} << 20;

std::string megabytes(std::size_t bytes) {
  return std::to_string(bytes >> 20) + " MB";
}

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw WriteError(path.string() + ": cannot be written: " + std::strerror(errno));
}

void write_all(int file, const std::string& contents, const std::filesystem::path& path) {
  std::size_t done = 0;
  while (done < contents.size()) {
    const ssize_t n = ::write(file, contents.data() + done, contents.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int reason = errno;
      ::close(file);
      errno = reason;
      fail(path);
    }
    done += static_cast<std::size_t>(n);
  }
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, const std::string& contents) {
  std::error_code error;
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
    if (error)
      throw WriteError(path.parent_path().string() + ": cannot be created: " + error.message());
  }
  const std::filesystem::path part = path.string() + ".part" + std::to_string(::getpid());
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail(path);
  write_all(file, contents, path);
  if (::fsync(file) != 0 || ::close(file) != 0) fail(path);
  if (::rename(part.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    ::unlink(part.c_str());
    errno = reason;
    fail(path);
  }
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InvalidFile({path.string()}, "is a folder, expected a file");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InvalidFile({path.string()}, std::string("cannot be read: ") + std::strerror(errno));
  // Piece by piece: a pipe or a device does not tell its size.
  std::string text;
  std::vector<char> piece(1 << 16);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > largest_file)
      throw InvalidFile({path.string()},
                        "is larger than " + megabytes(largest_file) + ", expected at most that");
  }
  return text;
}

}  // namespace pedicel::io
