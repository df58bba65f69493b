#include "engine/cluster/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "engine/core/stop.h"

extern char** environ;

namespace pedicel::cluster {

namespace {

constexpr std::size_t most_kept = std::size_t{64} << 10;  // bytes
constexpr std::chrono::seconds patience{10};              // from SIGTERM to SIGKILL

[[noreturn]] void cannot_start(const std::string& program, int error) {
  throw std::runtime_error(program + ": cannot be started: " + std::strerror(error));
}

/// Both ends of a pipe, closed when this goes.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) ends = {-1, -1};
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take_reading_end() { return std::exchange(ends[0], -1); }
};

void keep_tail(std::string& text, const char* bytes, std::size_t count) {
  text.append(bytes, count);
  if (text.size() > most_kept) text.erase(0, text.size() - most_kept);
}

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const Options& options) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  FileActions actions;
  Pipe output, errors;
  posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (!options.folder.empty())
    posix_spawn_file_actions_addchdir_np(actions.get(), options.folder.c_str());
  if (!options.log.empty()) {
    posix_spawn_file_actions_addopen(actions.get(), STDOUT_FILENO, options.log.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0644);
    posix_spawn_file_actions_adddup2(actions.get(), STDOUT_FILENO, STDERR_FILENO);
  } else if (!options.inherits_output) {
    posix_spawn_file_actions_adddup2(actions.get(), output.ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(actions.get(), errors.ends[1], STDERR_FILENO);
    output_end_ = output.take_reading_end();
    errors_end_ = errors.take_reading_end();
  }
  const int error =
      ::posix_spawnp(&process_, argv[0], actions.get(), nullptr, argv.data(), environ);
  if (error == 0) return;
  process_ = -1;
  for (const int end : {output_end_, errors_end_})
    if (end >= 0) ::close(end);
  cannot_start(arguments.front(), error);
}

Process::~Process() {
  if (process_ > 0) {
    ask_to_end();
    wait();
  }
  for (const int end : {output_end_, errors_end_})
    if (end >= 0) ::close(end);
}

void Process::ask_to_end() const {
  if (process_ > 0) ::kill(process_, SIGTERM);
}

void Process::read_some(int milliseconds) {
  std::array<pollfd, 2> ends{pollfd{output_end_, POLLIN, 0}, pollfd{errors_end_, POLLIN, 0}};
  if (::poll(ends.data(), ends.size(), milliseconds) <= 0) return;
  std::array<char, 4096> piece{};
  const std::array<std::pair<int*, std::string*>, 2> kept{std::pair{&output_end_, &output_},
                                                          std::pair{&errors_end_, &errors_}};
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (ends[i].revents == 0) continue;
    const ssize_t n = ::read(*kept[i].first, piece.data(), piece.size());
    if (n > 0)
      keep_tail(*kept[i].second, piece.data(), static_cast<std::size_t>(n));
    else if (n == 0)
      ::close(std::exchange(*kept[i].first, -1));
  }
}

bool Process::ended() {
  if (process_ < 0) return true;
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) != process_) return false;
  process_ = -1;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return true;
}

int Process::wait(bool to_its_end) {
  using Clock = std::chrono::steady_clock;
  bool asked = false;
  Clock::time_point since{};
  while (!ended()) {
    read_some(10);
    if (stop_requested && !to_its_end && !std::exchange(asked, true)) {
      ask_to_end();
      since = Clock::now();
    }
    if (asked && Clock::now() - since > patience) ::kill(process_, SIGKILL);
  }
  // What is still in the pipes; a grandchild that keeps them open is not waited for.
  for (int i = 0; i < 64 && (output_end_ >= 0 || errors_end_ >= 0); ++i) read_some(0);
  return exit_code_;
}

std::string output_of(const std::vector<std::string>& arguments) {
  Process process(arguments, {});
  if (const int code = process.wait(); code != 0) {
    const std::string words = last_line(process.errors());
    throw std::runtime_error(arguments.front() + ": " +
                             (words.empty() ? "exit code " + std::to_string(code) : words));
  }
  return process.output();
}

std::string last_line(const std::string& text) {
  std::size_t end = text.find_last_not_of("\r\n \t");
  if (end == std::string::npos) return {};
  const std::size_t start = text.find_last_of("\r\n", end);
  return text.substr(start == std::string::npos ? 0 : start + 1,
                     end - (start == std::string::npos ? 0 : start + 1) + 1);
}

}  // namespace pedicel::cluster
