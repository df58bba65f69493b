#include "plugins/discrepancy/procedure/deadline.h"

#include <chrono>

namespace pedicel::discrepancy {

Deadline::Deadline(const std::atomic<bool>* stop, double seconds) {
  using Clock = std::chrono::steady_clock;
  watch_ = std::jthread([this, stop, seconds, start = Clock::now()](std::stop_token released) {
    while (!released.stop_requested() && !over_) {
      const double gone = std::chrono::duration<double>(Clock::now() - start).count();
      over_ = gone >= seconds || (stop && *stop);
      // A tenth of what a person notices.
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
}

bool Deadline::release() {
  watch_.request_stop();
  if (watch_.joinable()) watch_.join();
  return over_.exchange(false);
}

}  // namespace pedicel::discrepancy
