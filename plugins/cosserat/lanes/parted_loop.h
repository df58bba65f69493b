#pragma once

#include <algorithm>
#include <cstddef>

#include "engine/core/thread_pool.h"

namespace pedicel::cosserat {

/// A loop cut into parts, one a thread and always the same one, so that what it works on stays in
/// that core's cache: equal stretches, in order, each a multiple of eight long but the last. Short
/// loops, and those without threads, are one part.
struct PartedLoop {
  ThreadPool* pool = nullptr;
  static constexpr int most_parts = 16;

  int parts(std::size_t count, std::size_t grain_size) const {
    if (!pool || pool->threads() == 1 || count < 2 * grain_size) return 1;
    return static_cast<int>(
        std::min({count / grain_size, std::size_t(pool->threads()), std::size_t(most_parts)}));
  }

  /// task(part, first, end), perhaps at once.
  template <class Task>
  void run(std::size_t count, int parts, const Task& task) const {
    const auto begin = [&](int part) {
      return part < parts ? (count * part / parts + 4) / 8 * 8 : count;
    };
    each(parts, [&](int part) { task(part, begin(part), begin(part + 1)); });
  }

  /// task(part), perhaps at once.
  template <class Task>
  void each(int parts, const Task& task) const {
    if (pool && parts > 1)
      pool->for_each(parts, task);
    else
      for (int part = 0; part < parts; ++part) task(part);
  }
};

}  // namespace pedicel::cosserat
