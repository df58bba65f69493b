#include "engine/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/files_read.h"

namespace pedicel::io {

namespace {

/// Bytes. What a program of this kind reads as text is far below; a disk image given by mistake is
/// not.
constexpr std::size_t largest_file = std::size_t{256} << 20;

std::string megabytes(std::size_t bytes) {
  return std::to_string(bytes >> 20) + " MB";
}

/// A file beside its target that becomes it, or goes.
class Part {
 public:
  explicit Part(const std::filesystem::path& target)
      : target_(target), name_(target.string() + ".part" + std::to_string(::getpid())) {
    file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file_ < 0) fail();
  }
  ~Part() {
    if (file_ >= 0) ::close(file_);
    if (!placed_) ::unlink(name_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(file_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail();
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
  }

  void place() {
    if (::fsync(file_) != 0) fail();
    if (::close(std::exchange(file_, -1)) != 0) fail();
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail();
    placed_ = true;
  }

 private:
  [[noreturn]] void fail() const {
    throw WriteError(target_.string() + ": cannot be written: " + std::strerror(errno));
  }

  const std::filesystem::path& target_;
  std::string name_;
  int file_ = -1;
  bool placed_ = false;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& path, const std::string& contents) {
  std::error_code error;
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
    if (error)
      throw WriteError(path.parent_path().string() + ": cannot be created: " + error.message());
  }
  // Renaming would put a plain file in the place of a device or a pipe.
  const auto there = std::filesystem::status(path, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there) &&
      !std::filesystem::is_directory(there))
    throw WriteError(path.string() + ": is a device or a pipe, expected a plain file, or none yet");
  Part part(path);
  part.write(contents);
  part.place();
}

void link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::create_hard_link(from, to, error);
  if (!error || (fs::equivalent(from, to, error) && !error)) return;
  // Beside the target and renamed, so that the name never stands for half a file.
  const fs::path part = to.string() + ".part";
  fs::copy_file(from, part, fs::copy_options::overwrite_existing, error);
  if (!error) fs::rename(part, to, error);
  if (error) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw WriteError(to.string() + ": cannot be written: " + error.message());
  }
}

std::string read_file(const std::filesystem::path& path) {
  note_file_read(path);
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
