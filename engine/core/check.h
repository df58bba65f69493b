#pragma once

#include <stdexcept>
#include <string>

namespace pedicel {

/// The interface was used wrongly at set-up: thrown with a sentence that names field,
/// value and broken bound.
class UsageError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

namespace detail {
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);
}

}  // namespace pedicel

/// Our own bug: always armed, in release builds too. Bad files are never asserted, they are
/// diagnosed (core/diagnostics.h).
#define PEDICEL_ASSERT(condition) \
  ((condition) ? void(0) : ::pedicel::detail::assertion_failed(#condition, __FILE__, __LINE__))
