#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pedicel::cosserat {

/// What a thread works on next, asked for a few lines of memory at a time while it works on
/// something else: it then stands in that core's own cache when its turn comes. More lines at once
/// would have to wait for each other.
class FetchAhead {
 public:
  void clear() {
    ranges_.clear();
    lines_ = next_ = 0;
  }
  /// Where it is gone when it is asked for, that is in vain and does no harm.
  template <class Vector>
  void add(const Vector& values) {
    const auto begin = reinterpret_cast<const char*>(values.data());
    const std::size_t bytes = values.size() * sizeof(values[0]);
    if (bytes == 0) return;
    ranges_.push_back({begin, begin + bytes});
    lines_ += (bytes + line - 1) / line;
  }
  /// From now on so many calls of some() ask for all of it.
  void share_out(std::size_t calls) {
    calls = std::max<std::size_t>(calls, 1);
    lines_a_call_ = (lines_ + calls - 1) / calls;
  }
  /// Asks for the next lines.
  void some() {
    for (std::size_t wanted = lines_a_call_; wanted > 0 && next_ < ranges_.size();) {
      Range& range = ranges_[next_];
      for (; wanted > 0 && range.begin < range.end; range.begin += line, --wanted)
        __builtin_prefetch(range.begin, 0, own_cache);
      if (range.begin >= range.end) ++next_;
    }
  }
  /// Whether all of it has been asked for.
  bool is_done() const { return next_ == ranges_.size(); }

 private:
  struct Range {
    const char *begin, *end;
  };
  static constexpr std::size_t line = 64;  // bytes
  static constexpr int own_cache = 2;      // a core's second one: the first is needed meanwhile

  std::vector<Range> ranges_;
  std::size_t lines_ = 0, lines_a_call_ = 0;
  std::size_t next_ = 0;  // of the ranges
};

}  // namespace pedicel::cosserat
