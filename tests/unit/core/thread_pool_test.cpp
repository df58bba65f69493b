#include "engine/core/thread_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <cmath>
#include <thread>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/state_hash.h"

namespace pedicel {
namespace {

TEST(ThreadPool, EveryTaskRunsExactlyOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const int count : {0, 1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
      pool.for_each(count, [&](int i) { ++runs[static_cast<std::size_t>(i)]; });
      for (const auto& run : runs) EXPECT_EQ(run.load(), 1);
    }
  }
}

std::uint64_t hash_with(int threads) {
  ThreadPool pool(threads);
  std::vector<double> values(500, 0.1);
  for (int round = 0; round < 50; ++round)
    pool.for_each(500, [&](int i) {
      double& value = values[static_cast<std::size_t>(i)];
      for (int k = 0; k < 20; ++k) value = std::sin(value * (i + 1)) + 0.5 * value;
    });
  StateHash hash;
  for (const double value : values) hash.add(value);
  return hash.value();
}

TEST(ThreadPool, AnyNumberOfThreadsGivesTheSameBits) {
  const std::uint64_t alone = hash_with(1);
  for (const int threads : {2, 3, 5, 8}) EXPECT_EQ(hash_with(threads), alone) << threads;
}

// Many short rounds on one pool: a worker that wakes late for one round must neither run a task of
// the next twice nor let a round end early.
TEST(ThreadPool, ManyShortRoundsStayInStep) {
  ThreadPool pool(4);
  std::vector<int> values(8, 0);
  for (int round = 1; round <= 20000; ++round) {
    pool.for_each(8, [&](int i) { ++values[static_cast<std::size_t>(i)]; });
    ASSERT_THAT(values, testing::Each(round)) << "after round " << round;
  }
}

// While all tasks of a round run at once, none can be idle and take another one's.
TEST(ThreadPool, AThreadKeepsItsTask) {
  constexpr int threads = 3;
  ThreadPool pool(threads);
  std::vector<std::thread::id> ran_by(threads);
  for (int round = 0; round < 300; ++round) {
    std::barrier all_begun(threads);
    pool.for_each(threads, [&](int i) {
      all_begun.arrive_and_wait();
      if (round == 0) ran_by[i] = std::this_thread::get_id();
      EXPECT_EQ(ran_by[i], std::this_thread::get_id()) << "round " << round;
    });
  }
  EXPECT_EQ(ran_by[0], std::this_thread::get_id());
}

TEST(ThreadPool, PoolsComeAndGo) {
  std::atomic<int> sum{0};
  for (int i = 0; i < 200; ++i) {
    ThreadPool pool(3);
    if (i % 2 == 0) pool.for_each(10, [&](int) { ++sum; });
  }
  EXPECT_EQ(sum.load(), 1000);
}

TEST(ThreadPool, NeedsAThread) {
  EXPECT_THAT([] { ThreadPool pool(0); },
              testing::ThrowsMessage<UsageError>(testing::StrEq("threads = 0: must be >= 1")));
}

}  // namespace
}  // namespace pedicel
