#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace pedicel {

/// A file whose reader waits until it is let go, and then finds it empty (a named pipe): for tests
/// of what goes on beside a reader. To be destroyed before what waits for the reader.
class SlowFile {
 public:
  /// Takes the place of a file.
  explicit SlowFile(std::filesystem::path path) : path_(std::move(path)) {
    std::filesystem::remove(path_);
    made_ = ::mkfifo(path_.c_str(), 0600) == 0;
  }
  ~SlowFile() { let_go(); }
  SlowFile(const SlowFile&) = delete;
  SlowFile& operator=(const SlowFile&) = delete;

  bool made() const { return made_; }
  /// Whoever waits for it, or comes later, finds an empty file.
  void let_go() {
    if (!made_) return;
    made_ = false;
    // Open for both, a pipe wakes all that wait; they find its end once this is closed.
    const int pipe = ::open(path_.c_str(), O_RDWR | O_NONBLOCK);
    const std::filesystem::path empty = path_.string() + ".empty";
    std::ofstream{empty};
    std::filesystem::rename(empty, path_);
    if (pipe >= 0) ::close(pipe);
  }

 private:
  std::filesystem::path path_;
  bool made_ = false;
};

}  // namespace pedicel
