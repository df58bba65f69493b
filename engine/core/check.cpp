#include "engine/core/check.h"

#include <cstdio>
#include <cstdlib>

namespace pedicel::detail {

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s (a bug in Pedicel)\n", file, line, condition);
  std::abort();
}

}  // namespace pedicel::detail
