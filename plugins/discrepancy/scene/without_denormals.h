#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace pedicel::discrepancy {

/// As long as it lives, numbers too small for full precision count as 0 in this thread: what dies
/// away after a swing would else take ten times as long to compute.
class WithoutDenormals {
 public:
#if defined(__SSE__)
  WithoutDenormals() : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | flush_and_take_for_zero);
  }
  ~WithoutDenormals() {
    _mm_setcsr(before_);
  }
#else
  WithoutDenormals() {}
  ~WithoutDenormals() {}
#endif
  WithoutDenormals(const WithoutDenormals&) = delete;
  WithoutDenormals& operator=(const WithoutDenormals&) = delete;

 private:
#if defined(__SSE__)
  static constexpr unsigned flush_and_take_for_zero = 0x8040;
  unsigned before_;
#endif
};

}  // namespace pedicel::discrepancy
