#pragma once

#include <array>
#include <chrono>

namespace pedicel::app {

/// How fast steps and snapshots come, over the last half second of wall time.
class RunRates {
 public:
  using Clock = std::chrono::steady_clock;

  /// After a step that took `seconds` of wall time and simulated `dt` (s).
  void step(double seconds, double dt);
  void snapshot() { ++snapshots_; }
  /// The simulation stands: the next half second begins with the next step.
  void rest();

  double real_time_factor() const { return real_time_factor_; }
  double steps_per_second() const { return steps_rate_; }
  double snapshots_per_second() const { return snapshots_rate_; }
  double ms_p50() const { return percentile(0.5); }
  double ms_p95() const { return percentile(0.95); }

 private:
  void close(double wall);
  double percentile(double share) const;

  std::array<double, 256> ms_{};  // of the last steps
  std::size_t count_ = 0;
  Clock::time_point start_;
  bool resting_ = true;
  double simulated_ = 0.0;
  long steps_ = 0, snapshots_ = 0;
  double real_time_factor_ = 0.0, steps_rate_ = 0.0, snapshots_rate_ = 0.0;
};

}  // namespace pedicel::app
