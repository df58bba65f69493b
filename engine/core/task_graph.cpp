#include "engine/core/task_graph.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "engine/core/check.h"

namespace pedicel {

namespace {

using Lists = std::vector<std::vector<int>>;

// What tasks with numbers side by side work on lies side by side, too: threads that have such tasks
// mixed fetch it from each other. On two threads that costs the rods a quarter of the walks that
// wait for nothing.
constexpr double worth_waiting = 1.25;

struct Schedule {
  Lists shares;      // by thread
  double end = 0.0;  // when the last task is done
};

// List scheduling (Graham 1969, SIAM Journal on Applied Mathematics 17): whoever is free takes, of
// what is ready, what comes first by `rank`.
Schedule schedule(const Lists& needs, const Lists& needed_by, const std::vector<double>& cost,
                  const std::vector<int>& rank, int threads) {
  const int n = static_cast<int>(needs.size());
  Schedule result;
  result.shares.resize(threads);
  using Ranked = std::pair<int, int>;  // rank, task
  std::priority_queue<Ranked, std::vector<Ranked>, std::greater<>> ready;
  std::vector<int> missing(n);
  for (int i = 0; i < n; ++i) {
    missing[i] = static_cast<int>(needs[i].size());
    if (missing[i] == 0) ready.emplace(rank[i], i);
  }
  using Running = std::tuple<double, int, int>;  // end, thread, task
  std::priority_queue<Running, std::vector<Running>, std::greater<>> running;
  std::priority_queue<int, std::vector<int>, std::greater<>> idle;
  for (int thread = 0; thread < threads; ++thread) idle.push(thread);
  while (!ready.empty() || !running.empty()) {
    for (; !ready.empty() && !idle.empty(); ready.pop(), idle.pop()) {
      const int task = ready.top().second, thread = idle.top();
      result.shares[thread].push_back(task);
      running.emplace(result.end + cost[task], thread, task);
    }
    const auto [end, thread, task] = running.top();
    running.pop();
    result.end = end;
    idle.push(thread);
    for (const int other : needed_by[task])
      if (--missing[other] == 0) ready.emplace(rank[other], other);
  }
  return result;
}

// Which thread gets which task if each gets tasks whose numbers follow each other: of each level,
// in order, as many as make the threads' costs equal so far.
std::vector<int> shared_out_by_number(const std::vector<int>& level,
                                      const std::vector<double>& cost, int threads) {
  std::vector<int> tasks(level.size()), thread_of(level.size());
  std::iota(tasks.begin(), tasks.end(), 0);
  std::ranges::stable_sort(tasks, std::ranges::less{}, [&](int i) { return level[i]; });
  std::vector<double> load(threads, 0.0);
  double total = 0.0;
  for (std::size_t first = 0, end = 0; first < tasks.size(); first = end) {
    for (; end < tasks.size() && level[tasks[end]] == level[tasks[first]]; ++end)
      total += cost[tasks[end]];
    int thread = 0;
    for (std::size_t k = first; k < end; ++k) {
      const int task = tasks[k];
      while (thread + 1 < threads && load[thread] + 0.5 * cost[task] > total / threads) ++thread;
      thread_of[task] = thread;
      load[thread] += cost[task];
    }
  }
  return thread_of;
}

// That, and with what is alone on its level, as the pieces of a stem are, all on one thread, on
// each in turn: which of them waits least for the branches is not to be told beforehand.
Lists ways_to_share_out(const std::vector<int>& level, const std::vector<double>& cost,
                        int threads) {
  Lists ways{shared_out_by_number(level, cost, threads)};
  for (int thread = 0; thread < threads; ++thread) {
    ways.push_back(ways.front());
    for (std::size_t i = 0; i < level.size(); ++i)
      if (std::ranges::count(level, level[i]) == 1) ways.back()[i] = thread;
  }
  return ways;
}

// Each thread does its tasks in the order given, in which what a task needs comes first.
Schedule in_order(const Lists& needs, const std::vector<double>& cost,
                  const std::vector<int>& order, const std::vector<int>& thread_of, int threads) {
  Schedule result;
  result.shares.resize(threads);
  std::vector<double> done(order.size(), 0.0), free_at(threads, 0.0);
  for (const int task : order) {
    double& time = free_at[thread_of[task]];
    for (const int other : needs[task]) time = std::max(time, done[other]);
    time += cost[task];
    done[task] = time;
    result.end = std::max(result.end, time);
    result.shares[thread_of[task]].push_back(task);
  }
  return result;
}

// Moves the borders between neighbouring threads' tasks of a level, one task at a time, while that
// ends sooner.
Schedule with_better_borders(const Lists& needs, const std::vector<double>& cost,
                             const std::vector<int>& order, const std::vector<int>& level,
                             std::vector<int> thread_of, int threads) {
  const int n = static_cast<int>(level.size());
  Schedule best = in_order(needs, cost, order, thread_of, threads);
  for (bool better = true; better;) {
    better = false;
    for (int i = 0; i < n; ++i) {
      for (const int step : {-1, 1}) {
        int other = i + step;  // the next one of the same level
        while (other >= 0 && other < n && level[other] != level[i]) other += step;
        if (other < 0 || other >= n || thread_of[other] == thread_of[i]) continue;
        const int before = std::exchange(thread_of[i], thread_of[other]);
        Schedule found = in_order(needs, cost, order, thread_of, threads);
        if (found.end < best.end) {
          best = std::move(found);
          better = true;
        } else {
          thread_of[i] = before;
        }
      }
    }
  }
  return best;
}

}  // namespace

TaskGraph::TaskGraph(const Lists& needs, const std::vector<double>& cost, int threads)
    : post_order_(needs.size()),
      pre_order_(needs.size()),
      post_order_walks_(std::max(0, threads)),
      pre_order_walks_(std::max(0, threads)) {
  if (threads < 1) throw UsageError("threads = " + std::to_string(threads) + ": must be >= 1");
  const int n = static_cast<int>(needs.size());
  Lists needed_by(n);
  for (int i = 0; i < n; ++i)
    for (const int other : needs[i]) needed_by[other].push_back(i);
  const auto flatten = [](const std::vector<std::vector<int>>& lists) {
    FlatLists flat;
    flat.begin.push_back(0);
    for (const std::vector<int>& list : lists) {
      flat.items.insert(flat.items.end(), list.begin(), list.end());
      flat.begin.push_back(static_cast<int>(flat.items.size()));
    }
    return flat;
  };
  needs_ = flatten(needs);
  needed_by_ = flatten(needed_by);

  // The task that most hangs on first, which is best where one way through the graph is long; or
  // all that needs nothing first, then what needs that and so on, which leaves no thread without
  // work where there are few long tasks at the end.
  std::vector<double> hangs_on(n, 0.0);  // cost of the longest way from the task to the end
  for (int i = n - 1; i >= 0; --i) {
    for (const int other : needed_by[i]) hangs_on[i] = std::max(hangs_on[i], hangs_on[other]);
    hangs_on[i] += cost[i];
  }
  std::vector<int> level(n, 0), order(n), rank(n);
  for (int i = 0; i < n; ++i)
    for (const int other : needs[i]) level[i] = std::max(level[i], level[other] + 1);
  const Lists by_number = ways_to_share_out(level, cost, threads);
  std::iota(order.begin(), order.end(), 0);
  Schedule quick, neighbours;
  quick.end = neighbours.end = std::numeric_limits<double>::infinity();
  const auto try_order = [&] {
    for (int k = 0; k < n; ++k) rank[order[k]] = k;
    const auto take_better = [](Schedule& best, Schedule found) {
      if (found.end < best.end) best = std::move(found);
    };
    take_better(quick, schedule(needs, needed_by, cost, rank, threads));
    for (const std::vector<int>& thread_of : by_number)
      take_better(neighbours, with_better_borders(needs, cost, order, level, thread_of, threads));
  };
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](int i) { return hangs_on[i]; });
  try_order();
  std::ranges::stable_sort(order, std::ranges::less{}, [&](int i) { return level[i]; });
  try_order();
  shares_ = std::move((neighbours.end <= worth_waiting * quick.end ? neighbours : quick).shares);
  owner_.resize(n);
  for (int thread = 0; thread < threads; ++thread)
    for (const int task : shares_[thread]) owner_[task] = thread;
}

}  // namespace pedicel
