// Work on a thread of its own. Built by itself, too, so that it runs under the thread sanitizer.

#include "app/session/measured/background_job.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pedicel::app {
namespace {

void wait_for_end(const BackgroundJob& job) {
  while (!job.has_ended()) std::this_thread::yield();
}

// What the work wrote is seen by whoever sees that it ended: nothing else guards it.
TEST(BackgroundJob, WhatItMadeIsThereOnceItHasEnded) {
  for (int round = 0; round < 200; ++round) {
    std::string made;
    BackgroundJob job([&](const std::atomic<bool>&) { made = "done " + std::to_string(round); });
    wait_for_end(job);
    EXPECT_EQ(made, "done " + std::to_string(round));
    EXPECT_EQ(job.fault(), "");
    EXPECT_FALSE(job.was_stopped());
  }
}

TEST(BackgroundJob, StopsWhereItIsAsked) {
  std::atomic<int> turns{0};
  BackgroundJob job([&](const std::atomic<bool>& stop) {
    while (!stop) ++turns;
  });
  while (turns == 0) std::this_thread::yield();
  EXPECT_FALSE(job.has_ended());
  job.stop();
  wait_for_end(job);
  EXPECT_TRUE(job.was_stopped());
}

TEST(BackgroundJob, AFaultIsKept) {
  for (int round = 0; round < 200; ++round) {
    BackgroundJob job([](const std::atomic<bool>&) { throw std::runtime_error("no such trial"); });
    wait_for_end(job);
    EXPECT_EQ(job.fault(), "no such trial");
  }
}

// It goes with its owner, who may be gone before the work has begun.
TEST(BackgroundJob, ItsOwnerStopsItAndWaits) {
  bool ended = false;
  for (int round = 0; round < 200; ++round) {
    ended = false;
    {
      BackgroundJob job([&](const std::atomic<bool>& stop) {
        while (!stop) std::this_thread::yield();
        ended = true;
      });
    }
    EXPECT_TRUE(ended);
  }
}

}  // namespace
}  // namespace pedicel::app
