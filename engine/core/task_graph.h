#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "engine/core/thread_pool.h"

namespace pedicel {

/// Tasks some of which need others done first, as a tree's branches come before its stem, or, the
/// other way round, the stem before its branches. Each thread has its own tasks, shared out
/// beforehand, mostly with numbers side by side, so that what they work on stays in that core's
/// cache. A thread that needs what another one is about to do waits for it a while, then does it;
/// and so it does the tasks of threads that have not begun: any number of threads gets through.
class TaskGraph {
 public:
  /// `needs[i]`: the tasks below i that task i needs; `cost[i]` > 0, in any unit; `threads` >= 1.
  TaskGraph(const std::vector<std::vector<int>>& needs, const std::vector<double>& cost,
            int threads);

  int size() const { return static_cast<int>(needs_.begin.size()) - 1; }
  /// What task i needs.
  std::span<const int> needs(int i) const { return needs_.of(i); }
  /// The share of each thread, in order.
  std::span<const int> tasks_of(int thread) const { return shares_[thread]; }
  int threads() const { return static_cast<int>(shares_.size()); }

  /// task(i) for all, in any order.
  template <class Task>
  void each(ThreadPool& pool, const Task& task) {
    const unsigned round = ++round_;
    pool.for_each(threads(), [&](int thread) {
      own_first(thread, round, [&](int i) {
        do_once(
            post_order_[i], round, [] {}, [&] { task(i); });
      });
    });
  }

  /// task(i) for all, each after those that it needs.
  template <class Task>
  void post_order(ThreadPool& pool, const Task& task) {
    const unsigned round = ++round_;
    pool.for_each(threads(), [&](int thread) {
      own_first(thread, round, [&](int i) { do_post_order(thread, i, round, task); });
    });
  }

  /// The other way round: each before those that it needs.
  template <class Task>
  void pre_order(ThreadPool& pool, const Task& task) {
    const unsigned round = ++round_;
    pool.for_each(threads(), [&](int thread) {
      own_last(thread, round, [&](int i) {
        do_pre_order(
            thread, i, round, [](int) {}, task);
      });
    });
  }

  /// Both in one go: pre_order(i) after post_order() of i and of all that i is needed by.
  template <class PostOrder, class PreOrder>
  void post_and_pre_order(ThreadPool& pool, const PostOrder& in, const PreOrder& out) {
    const unsigned round = ++round_;
    pool.for_each(threads(), [&](int thread) {
      own_first(thread, round, [&](int i) { do_post_order(thread, i, round, in); });
      own_last(thread, round, [&](int i) {
        const auto before = [&](int task) {
          leave_to_owner(thread, task, post_order_[task], round,
                         [&] { do_post_order(thread, task, round, in); });
          await_end(post_order_[task], round);
        };
        do_pre_order(thread, i, round, before, out);
      });
    });
  }

 private:
  struct FlatLists {  // the list of i: items[begin[i]] to items[begin[i + 1]]
    std::vector<int> begin, items;
    std::span<const int> of(int i) const {
      return {items.data() + begin[i], items.data() + begin[i + 1]};
    }
  };
  // In which round a task was last begun, and done. A line of the cache each: else what one thread
  // marks would take the marks beside it from another one.
  struct alignas(64) Mark {
    std::atomic<unsigned> begun{0}, done{0};
  };
  // In which round a thread last began a walk.
  struct alignas(64) Walk {
    std::atomic<unsigned> round{0};
  };

  // All tasks, a thread's own ones first, then those of threads that have not begun. Those that
  // have are not helped: what a task works on is in their core's cache, and would have to come over
  // and back again.
  template <class Do>
  void own_first(int thread, unsigned round, const Do& todo) {
    walk(thread, round, post_order_walks_,
         [&](const std::vector<int>& share, std::size_t k) { todo(share[k]); });
  }
  // Likewise from the last to the first.
  template <class Do>
  void own_last(int thread, unsigned round, const Do& todo) {
    walk(thread, round, pre_order_walks_,
         [&](const std::vector<int>& share, std::size_t k) { todo(share[share.size() - 1 - k]); });
  }
  template <class Do>
  void walk(int thread, unsigned round, std::vector<Walk>& walks, const Do& todo) {
    Walk& own = walks[thread];
    own.round.store(round, std::memory_order_release);
    for (std::size_t k = 0; k < shares_[thread].size(); ++k) todo(shares_[thread], k);
    for (int other = 1; other < threads(); ++other) {
      const int helped = (thread + other) % threads();
      if (walks[helped].round.load(std::memory_order_acquire) == round) continue;
      for (std::size_t k = 0; k < shares_[helped].size(); ++k) todo(shares_[helped], k);
    }
  }

  // Does a task after those that it needs, if nobody has begun it.
  template <class First, class Task>
  static void do_once(Mark& mark, unsigned round, const First& first, const Task& task) {
    if (mark.begun.load(std::memory_order_relaxed) == round ||
        mark.begun.exchange(round, std::memory_order_relaxed) == round)
      return;
    first();
    task();
    mark.done.store(round, std::memory_order_release);
  }
  // Does it unless its own thread does so within some microseconds, if that is under way. Each
  // thread has its tasks in an order in which what they need comes first, so who is waited for does
  // not wait for this one.
  template <class Do>
  void leave_to_owner(int thread, int task, const Mark& mark, unsigned round, const Do& todo) {
    const int owner = owner_[task];
    const auto is_under_way = [&](const Walk& walk) {
      return walk.round.load(std::memory_order_relaxed) == round;
    };
    if (owner != thread &&
        (is_under_way(post_order_walks_[owner]) || is_under_way(pre_order_walks_[owner])) &&
        await([&] { return mark.begun.load(std::memory_order_relaxed) == round; }, spin_count))
      return;
    todo();
  }
  // Nobody waits in a circle: who waits for a task stands behind one that needs it.
  static void await_end(const Mark& mark, unsigned round) {
    await([&] { return mark.done.load(std::memory_order_acquire) == round; });
  }
  template <class Task>
  void do_post_order(int thread, int i, unsigned round, const Task& task) {
    const auto others = [&] {
      for (const int other : needs_.of(i))
        leave_to_owner(thread, other, post_order_[other], round,
                       [&] { do_post_order(thread, other, round, task); });
      for (const int other : needs_.of(i)) await_end(post_order_[other], round);
    };
    do_once(post_order_[i], round, others, [&] { task(i); });
  }
  template <class First, class Task>
  void do_pre_order(int thread, int i, unsigned round, const First& first, const Task& task) {
    const auto others = [&] {
      first(i);
      for (const int other : needed_by_.of(i))
        leave_to_owner(thread, other, pre_order_[other], round,
                       [&] { do_pre_order(thread, other, round, first, task); });
      for (const int other : needed_by_.of(i)) await_end(pre_order_[other], round);
    };
    do_once(pre_order_[i], round, others, [&] { task(i); });
  }

  static constexpr unsigned spin_count = 2048;  // turns of waiting

  FlatLists needs_, needed_by_;
  std::vector<int> owner_;  // by task
  std::vector<std::vector<int>> shares_;
  std::vector<Mark> post_order_, pre_order_;              // by task
  std::vector<Walk> post_order_walks_, pre_order_walks_;  // by thread
  unsigned round_ = 0;
};

}  // namespace pedicel
