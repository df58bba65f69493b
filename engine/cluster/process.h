#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pedicel::cluster {

/// A program that was started: one of our own, or one of Slurm's.
class Process {
 public:
  struct Options {
    std::filesystem::path folder;  ///< where it runs; empty: here
    /// Its standard output and standard error go there, at the end; empty: they are kept here.
    std::filesystem::path log;
    bool inherits_output = false;  ///< both stay as ours are
  };

  /// `arguments[0]` is looked up in PATH; no shell is between. Throws std::runtime_error with the
  /// system's reason where it cannot be started.
  Process(const std::vector<std::string>& arguments, const Options& options);
  /// Ends it, if it is still there, and waits.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Whether it has ended; does not wait.
  bool ended();
  /// Waits. Where stop_requested it is asked to end, and after ten seconds ended, unless
  /// `to_its_end`. The exit code, 128 plus the signal where one ended it.
  int wait(bool to_its_end = false);
  void ask_to_end() const;  ///< SIGTERM

  /// What it has written to standard output and to standard error so far, at most the last 64 KB
  /// of each; empty where that is not kept.
  const std::string& output() const { return output_; }
  const std::string& errors() const { return errors_; }

 private:
  void read_some(int milliseconds);

  pid_t process_ = -1;
  int exit_code_ = -1, output_end_ = -1, errors_end_ = -1;
  std::string output_, errors_;
};

/// Runs a program to its end and gives what it wrote to standard output. Throws std::runtime_error
/// with its last words where it fails.
std::string output_of(const std::vector<std::string>& arguments);

/// The last line of a text that is not empty.
std::string last_line(const std::string& text);

}  // namespace pedicel::cluster
