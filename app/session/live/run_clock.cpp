#include "app/session/live/run_clock.h"

namespace pedicel::app {

namespace {

/// A simulation that has fallen back by more than this no longer tries to catch up.
constexpr std::chrono::milliseconds most_behind{100};

}  // namespace

void RunClock::start(double time) {
  start_ = Wall::now();
  start_time_ = time;
}

bool RunClock::is_held(double time) const {
  constexpr double rounding = 1e-9;  // s, of a time that is a sum of steps
  return held_ && time >= *held_ - rounding;
}

RunClock::Wall::time_point RunClock::due(double time) const {
  const double ahead = time - start_time_;
  return start_ +
         std::chrono::duration_cast<Wall::duration>(std::chrono::duration<double>(ahead / speed_));
}

void RunClock::let_go_of_delay(double time) {
  if (speed_ > 0.0 && Wall::now() > due(time) + most_behind) start(time);
}

}  // namespace pedicel::app
