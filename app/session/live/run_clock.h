#pragma once

#include <chrono>
#include <optional>

namespace pedicel::app {

/// How simulated time goes against the clock on the wall: when the next step of a run that plays is
/// due, and where it has to wait.
class RunClock {
 public:
  using Wall = std::chrono::steady_clock;

  /// Counts anew from now, at this simulated time (s).
  void start(double time);
  /// Simulated s a wall s, >= 0; 0: as fast as it goes. To be followed by start().
  void set_speed(double speed) { speed_ = speed; }
  double speed() const { return speed_; }

  /// Steps go to that time (s) as fast as they can, and wait there.
  void hold_at(std::optional<double> time) { held_ = time; }
  bool holds() const { return held_.has_value(); }
  /// Whether a run at this time (s) waits.
  bool is_held(double time) const;

  /// When the step from this time (s) on is due; the speed must not be 0.
  Wall::time_point due(double time) const;
  /// A run that has fallen back too far does not try to catch up.
  void let_go_of_delay(double time);

 private:
  Wall::time_point start_;
  double start_time_ = 0.0;  // s, simulated, at start_
  double speed_ = 1.0;
  std::optional<double> held_;  // s
};

}  // namespace pedicel::app
