// Tasks that need others: every one once, after what it needs, on any number of threads, and in as
// little time as list scheduling promises.
#include "engine/core/task_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "engine/core/check.h"
#include "engine/core/random.h"

namespace pedicel {
namespace {

using Needs = std::vector<std::vector<int>>;

// Each of n tasks needs up to three of those before it.
Needs random_needs(int n, std::uint64_t seed) {
  Random random(seed);
  Needs needs(n);
  for (int i = 1; i < n; ++i)
    for (int k = 0; k < i % 4; ++k) {
      const int other = static_cast<int>(random.uniform(0.0, 1.0) * i);
      if (!testing::Value(needs[i], testing::Contains(other))) needs[i].push_back(other);
    }
  return needs;
}

// When tasks began and ended, by one clock for all threads.
struct Times {
  explicit Times(int n) : runs(n), begun(n), ended(n) {}
  void run(int i) {
    begun[i] = ++clock;
    ++runs[i];
    if (i % 16 == 0) std::this_thread::yield();
    ended[i] = ++clock;
  }
  std::atomic<int> clock{0};
  std::vector<std::atomic<int>> runs, begun, ended;
};

TEST(TaskGraph, EveryTaskRunsOnceAfterWhatItNeeds) {
  constexpr int n = 200;
  for (const int threads : {1, 2, 3, 5}) {
    for (const int pool_threads : {1, 2, 4}) {  // more shares than threads, too
      const Needs needs = random_needs(n, 7 * threads);
      TaskGraph graph(needs, std::vector<double>(n, 1.0), threads);
      ThreadPool pool(pool_threads);
      for (int round = 0; round < 50; ++round) {
        Times in(n), out(n), there(n), back(n);
        graph.post_order(pool, [&](int i) { in.run(i); });
        graph.pre_order(pool, [&](int i) { out.run(i); });
        graph.post_and_pre_order(
            pool, [&](int i) { there.run(i); }, [&](int i) { back.run(i); });
        for (int i = 0; i < n; ++i) {
          for (const Times* times : {&in, &out, &there, &back}) ASSERT_EQ(times->runs[i], 1);
          for (const int other : needs[i]) {
            ASSERT_LT(in.ended[other], in.begun[i]);
            ASSERT_LT(there.ended[other], there.begun[i]);
            ASSERT_LT(out.ended[i], out.begun[other]);
            ASSERT_LT(back.ended[i], back.begun[other]);
          }
        }
      }
    }
  }
}

// Pre-order after post-order, of the task itself as well: what it leaves is what the other one
// reads.
TEST(TaskGraph, GoesBackOverWhatIsDone) {
  constexpr int n = 300;
  const Needs needs = random_needs(n, 3);
  std::vector<std::vector<int>> needed_by(n);
  for (int i = 0; i < n; ++i)
    for (const int other : needs[i]) needed_by[other].push_back(i);
  std::vector<double> expected_sum(n, 1.0), expected(n);
  for (int i = 0; i < n; ++i)
    for (const int other : needs[i]) expected_sum[i] += 0.3 * expected_sum[other];
  for (int i = n - 1; i >= 0; --i) {
    expected[i] = expected_sum[i];
    for (const int other : needed_by[i]) expected[i] += 0.3 * expected[other];
  }
  for (const int threads : {1, 2, 4}) {
    TaskGraph graph(needs, std::vector<double>(n, 1.0), threads);
    ThreadPool pool(threads);
    for (int round = 0; round < 200; ++round) {
      std::vector<double> sum(n, 1.0), value(n);
      graph.post_and_pre_order(
          pool,
          [&](int i) {
            for (const int other : needs[i]) sum[i] += 0.3 * sum[other];
          },
          [&](int i) {
            value[i] = sum[i];
            for (const int other : needed_by[i]) value[i] += 0.3 * value[other];
          });
      ASSERT_EQ(value, expected) << threads << " threads, round " << round;
    }
  }
}

// A stem of three pieces with three branches of 40 (the hanging tree without its twigs): each
// thread gets branches side by side, and first those that the outer pieces wait for. What is done
// after 94 that way is not done before with any other.
TEST(TaskGraph, SharesOutNeighboursTogether) {
  const Needs needs = {{}, {}, {}, {2}, {1, 3}, {0, 4}};
  const std::vector<double> cost = {40, 40, 40, 14, 14, 14};
  const TaskGraph graph(needs, cost, 2);
  EXPECT_THAT(graph.tasks_of(0), testing::ElementsAre(1, 0));
  EXPECT_THAT(graph.tasks_of(1), testing::ElementsAre(2, 3, 4, 5));
}

// Side by side, 2 and 3 would take 60 before the long task that needs them begins, and all 120; one
// a thread, all take 90.
TEST(TaskGraph, SharesOutByWhatHangsOnATaskWhereNeighboursWait) {
  const Needs needs = {{}, {}, {}, {}, {2, 3}};
  const std::vector<double> cost = {30, 30, 30, 30, 60};
  const TaskGraph graph(needs, cost, 2);
  EXPECT_THAT(graph.tasks_of(0), testing::ElementsAre(2, 0, 1));
  EXPECT_THAT(graph.tasks_of(1), testing::ElementsAre(3, 4));
}

// When the last task is done if each thread does its own in order.
double end_of(const TaskGraph& graph, const Needs& needs, const std::vector<double>& cost) {
  std::vector<double> done(needs.size(), -1.0), free_at(graph.threads(), 0.0);
  std::vector<std::size_t> next(graph.threads(), 0);
  for (bool any = true; any;) {
    any = false;
    for (int thread = 0; thread < graph.threads(); ++thread) {
      if (next[thread] == graph.tasks_of(thread).size()) continue;
      const int task = graph.tasks_of(thread)[next[thread]];
      double time = free_at[thread];
      bool ready = true;
      for (const int other : needs[task]) {
        ready = ready && done[other] >= 0.0;
        time = std::max(time, done[other]);
      }
      if (!ready) continue;
      done[task] = free_at[thread] = time + cost[task];
      ++next[thread];
      any = true;
    }
  }
  return *std::ranges::max_element(done);
}

// The hanging tree: 17 packs of twigs of 10 rows on three of branches of 40, on a stem in pieces of
// 11, 15 and 16. Shared out by number the first thread has half of the branches and twigs and the
// stem, and all is done after 191; with one pack of twigs moved over to it, after 182, when the
// branches of the stem's last two pieces come just in time. Where the second thread has the stem,
// whose tip carries that thread's branches, and all but the last piece's branches, the first one
// is done with those after 160, and all after 176: nobody has waited but for the last piece.
TEST(TaskGraph, MovesBordersBetweenThreadsWhereThatEndsSooner) {
  Needs needs(23);
  std::vector<double> cost(23, 10.0);
  for (int twigs = 0; twigs < 17; ++twigs)
    for (int branches = 17; branches < 20; ++branches)
      if (twigs * 8 < 48 * (branches - 16) && std::min(twigs * 8 + 8, 132) > 48 * (branches - 17))
        needs[branches].push_back(twigs);
  for (int branches = 17; branches < 20; ++branches) cost[branches] = 40.0;
  cost[20] = 11.0;
  cost[21] = 15.0;
  cost[22] = 16.0;
  needs[20] = {19};
  needs[21] = {18, 20};
  needs[22] = {17, 21};
  const TaskGraph graph(needs, cost, 2);
  EXPECT_EQ(end_of(graph, needs, cost), 176.0);
}

TEST(TaskGraph, NeedsAThread) {
  EXPECT_THAT([] { TaskGraph graph({}, {}, 0); },
              testing::ThrowsMessage<UsageError>(testing::StrEq("threads = 0: must be >= 1")));
}

}  // namespace
}  // namespace pedicel
