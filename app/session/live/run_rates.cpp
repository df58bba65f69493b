#include "app/session/live/run_rates.h"

#include <algorithm>
#include <vector>

namespace pedicel::app {

void RunRates::step(double seconds, double dt) {
  const auto now = Clock::now();
  if (resting_) {
    resting_ = false;
    start_ =
        now - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    steps_ = snapshots_ = 0;
    simulated_ = 0.0;
  }
  ms_[count_++ % ms_.size()] = 1.0e3 * seconds;
  ++steps_;
  simulated_ += dt;
  const double wall = std::chrono::duration<double>(now - start_).count();
  if (wall >= 0.5) close(wall);
}

void RunRates::close(double wall) {
  real_time_factor_ = simulated_ / wall;
  steps_rate_ = static_cast<double>(steps_) / wall;
  snapshots_rate_ = static_cast<double>(snapshots_) / wall;
  start_ = Clock::now();
  steps_ = snapshots_ = 0;
  simulated_ = 0.0;
}

void RunRates::rest() {
  if (!resting_ && steps_ > 20) {
    const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
    if (wall > 0.05) close(wall);
  }
  resting_ = true;
}

double RunRates::percentile(double share) const {
  const std::size_t held = std::min(count_, ms_.size());
  if (held == 0) return 0.0;
  std::vector<double> sorted(ms_.begin(), ms_.begin() + static_cast<long>(held));
  const auto place = sorted.begin() + static_cast<long>(share * static_cast<double>(held - 1));
  std::nth_element(sorted.begin(), place, sorted.end());
  return *place;
}

}  // namespace pedicel::app
