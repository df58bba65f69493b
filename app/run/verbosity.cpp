#include "pedicel/app/run/verbosity.h"

#include <atomic>
#include <cstdarg>
#include <cstdio>

namespace pedicel::app {

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
  std::vfprintf(stderr, format, arguments);
  va_end(arguments);
  std::fputc('\n', stderr);
}

}  // namespace pedicel::app
