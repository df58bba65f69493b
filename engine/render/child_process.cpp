#include "engine/render/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>

extern char** environ;

namespace pedicel::render {

namespace {

/// Starts the program with its input on `input` and its errors in `errors`; -1 where it cannot be.
int spawn(const std::vector<std::string>& arguments, int input, int errors) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t ours;
  sigemptyset(&ours);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) sigaddset(&ours, signal);
  posix_spawnattr_setsigmask(&attributes, &ours);
  pid_t process = -1;
  const int error = ::posix_spawnp(&process, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? process : -1;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) : errors_(std::tmpfile()) {
  // A socket instead of a pipe: writing to one whose reader has gone can be told not to raise
  // SIGPIPE, which would end the simulation.
  int ends[2];
  if (!errors_ || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
  process_ = spawn(arguments, ends[1], ::fileno(errors_));
  ::close(ends[1]);
  input_ = ends[0];
}

ChildProcess::~ChildProcess() {
  finish();
  if (errors_) std::fclose(errors_);
}

bool ChildProcess::send(std::span<const std::uint8_t> bytes) {
  while (started() && input_ >= 0 && !bytes.empty()) {
    const ssize_t n = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return bytes.empty();
}

int ChildProcess::finish() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
  if (!started()) return exit_code_;
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return exit_code_;
}

std::string ChildProcess::complaint() const {
  std::string text;
  if (!errors_) return text;
  std::rewind(errors_);
  char line[512];
  while (std::fgets(line, sizeof line, errors_)) text = line;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text;
}

}  // namespace pedicel::render
