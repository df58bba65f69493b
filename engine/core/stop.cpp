#include "engine/core/stop.h"

#include <signal.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace pedicel {

std::atomic<bool> stop_requested{false};

namespace {

std::atomic<int> stop_signal{0};
std::atomic<bool> in_good_order{false};
std::atomic<long> first_signal_at{0};  // ms

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<long>::is_always_lock_free,
              "used in a signal handler");

/// `timeout` and terminals send a signal to the program and to its group: that is one, not two.
constexpr long one_signal = 100;  // ms

long milliseconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000L * now.tv_sec + now.tv_nsec / 1000000L;
}

[[noreturn]] void end_at_once(int signal, std::string_view words) {
  if (signal != SIGPIPE) [[maybe_unused]]
    const ssize_t written = ::write(STDERR_FILENO, words.data(), words.size());
  ::_exit(128 + signal);
}

extern "C" void on_stop_signal(int signal) {
  if (!in_good_order) end_at_once(signal, "\nstopped; nothing was written\n");
  int none = 0;
  if (stop_signal.compare_exchange_strong(none, signal)) {
    first_signal_at = milliseconds();
    stop_requested = true;
    return;
  }
  const bool comes_in_numbers = signal == SIGXCPU || signal == SIGPIPE;
  if (!comes_in_numbers && milliseconds() - first_signal_at >= one_signal)
    end_at_once(signal, "\nstopped at once\n");
}

/// `ulimit -t` sets both limits, and the kernel kills at the hard one without a word before: so the
/// soft one, at which SIGXCPU comes, is set some seconds before it.
void be_told_before_cpu_time_ends() {
  constexpr rlim_t ahead = 2;  // s
  rlimit limit{};
  if (::getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_max == RLIM_INFINITY) return;
  const rlim_t told = limit.rlim_max - std::min(ahead, limit.rlim_max / 2);
  limit.rlim_cur = std::min(limit.rlim_cur, std::max(told, rlim_t{1}));
  ::setrlimit(RLIMIT_CPU, &limit);
}

}  // namespace

Stopped::Stopped() : std::runtime_error("stopped by the user") {}

void throw_if_stopped() {
  if (stop_requested.load(std::memory_order_relaxed)) throw Stopped();
}

int stop_exit_code() {
  const int signal = stop_signal;
  return 128 + (signal ? signal : SIGINT);
}

void hear_stop_signals() {
  struct sigaction action {};
  action.sa_handler = on_stop_signal;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
  ::signal(SIGXFSZ, SIG_IGN);  // `ulimit -f`: the write fails then, as on a full disk
  be_told_before_cpu_time_ends();
}

void stop_in_good_order() {
  in_good_order = true;
}

}  // namespace pedicel
