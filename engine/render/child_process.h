#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

namespace pedicel::render {

/// Another program that reads our bytes from its standard input. Started without a shell, so that
/// no character of a file name means anything; in a process group of its own and deaf to the
/// signals that ask programs to stop, so that these end only us and we can close its input in good
/// order. It ends by itself when its input does: also where we were killed.
class ChildProcess {
 public:
  /// `arguments[0]` is looked up in PATH. started() is false where it cannot be run.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  /// Closes the input and waits.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool started() const { return process_ > 0; }
  /// Sends all bytes; false where the program has gone (no SIGPIPE is raised).
  bool send(std::span<const std::uint8_t> bytes);
  /// Closes the input, waits for the end, and gives the exit code (-1: not started, or killed).
  int finish();
  /// The last words on its standard error.
  std::string complaint() const;

 private:
  int process_ = -1, input_ = -1, exit_code_ = -1;
  std::FILE* errors_ = nullptr;
};

}  // namespace pedicel::render
