#include "engine/core/verbosity.h"

#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel {

namespace {

std::atomic<Verbosity> level_now{Verbosity::lines};

}  // namespace

Verbosity verbosity() {
  return level_now;
}

void set_verbosity(Verbosity level) {
  level_now = level;
}

void say(Verbosity level, const char* format, ...) {
  if (level > verbosity()) return;
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list again;
  va_copy(again, arguments);
  std::string text(static_cast<std::size_t>(std::max(0, std::vsnprintf(nullptr, 0, format, again))),
                   '\0');
  va_end(again);
  std::vsnprintf(text.data(), text.size() + 1, format, arguments);
  va_end(arguments);
  // Names of files and things may hold what a terminal obeys.
  std::string shown;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    shown += printable(std::string_view(text).substr(at, end - at), 4 * text.size()) + '\n';
    at = end + 1;
  }
  std::fputs(shown.c_str(), stderr);
}

}  // namespace pedicel
