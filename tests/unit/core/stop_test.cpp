// What signals do to a program before and after it has begun output.
#include "engine/core/stop.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace pedicel {
namespace {

void wait_ms(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

/// The exit code of a child that does this and then ends with 0; -1 where a signal ended it.
template <class Deed>
int exit_code_of(const Deed& deed) {
  const pid_t child = ::fork();
  if (child == 0) {
    hear_stop_signals();
    deed();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class StopSignal : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(All, StopSignal,
                         ::testing::Values(SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE));

TEST_P(StopSignal, EndsAtOnceWhereNothingWasBegun) {
  EXPECT_EQ(exit_code_of([] { ::raise(GetParam()); }), 128 + GetParam());
}

TEST_P(StopSignal, IsOnlyNotedOnceOutputWasBegun) {
  const auto deed = [] {
    stop_in_good_order();
    throw_if_stopped();
    ::raise(GetParam());
    try {
      throw_if_stopped();
    } catch (const Stopped&) {
      ::_exit(stop_requested ? stop_exit_code() : 1);
    }
  };
  EXPECT_EQ(exit_code_of(deed), 128 + GetParam());
}

// `timeout` and terminals signal the program and its group: the second comes at once.
TEST(StopSignals, ASecondOneALittleLaterEndsAtOnce) {
  const auto twice = [](int first, int second, int pause) {
    return exit_code_of([=] {
      stop_in_good_order();
      ::raise(first);
      wait_ms(pause);
      ::raise(second);
    });
  };
  EXPECT_EQ(twice(SIGTERM, SIGTERM, 0), 0);
  EXPECT_EQ(twice(SIGTERM, SIGTERM, 150), 143);
  EXPECT_EQ(twice(SIGTERM, SIGINT, 150), 130);
  EXPECT_EQ(twice(SIGXCPU, SIGXCPU, 150), 0);
  EXPECT_EQ(twice(SIGXCPU, SIGINT, 150), 130);
}

TEST(StopSignals, NohupKeepsItsMeaning) {
  const auto deed = [] {
    ::signal(SIGHUP, SIG_IGN);
    hear_stop_signals();
    ::raise(SIGHUP);
  };
  EXPECT_EQ(exit_code_of(deed), 0);
}

}  // namespace
}  // namespace pedicel
