// Clocks of forces. What is led slowly pulls back at the same time or before, never half a second
// later; what was let go pulls no longer.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

// As in drive_check: as stated the path explains less than half, with another clock nine tenths.
constexpr double contradicts = 0.5, agrees = 0.9, much_better = 0.25;
constexpr double least_shift = 0.5, most_shift = 60.0, grid = 0.05;  // s
constexpr double most_driven = 0.5;  // of the path's motion must be seen with the other clock
constexpr int least_rows = 10;
// After the release, of how far the force went before. Less is what a sensor's own drift and
// ringing may do.
constexpr double goes_on = 0.3;
constexpr double visible = 20.0;     // times the force's noise
constexpr double least_time = 0.35;  // s, for a release that is late
// Sensors resolve their range about so well.
constexpr double force_noise = 1.0e-3;  // of the force's range, where it is not stated

const std::string expected = ": expected seconds since the trial began, the same in all its tables";

struct ForceUnit {
  const char* name;
  double scale;
};
constexpr ForceUnit units[] = {{"milliseconds", 1e3},
                               {"microseconds", 1e6},
                               {"minutes", 1.0 / 60.0},
                               {"kiloseconds", 1e-3},
                               {"hours", 1.0 / 3600.0}};

// How far the components go in a stretch of time, the farthest of them.
struct Range {
  int rows = 0;
  double size = 0.0;  ///< N
};
Range range(const Track& force, double from, double to) {
  Range range;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  for (std::size_t i = 0; i < force.time.size(); ++i) {
    // Up to, and not at, the release: the sample there may be of either.
    if (force.time[i] < from || force.time[i] >= to) continue;
    // A range needs no mean, and so no guess of where the force would be without the drive.
    low = range.rows == 0 ? force.place[i] : Vec3(low.cwiseMin(force.place[i]));
    high = range.rows == 0 ? force.place[i] : Vec3(high.cwiseMax(force.place[i]));
    ++range.rows;
  }
  range.size = (high - low).maxCoeff();
  return range;
}

std::optional<Fault> after_release(const TrialView& view, const Track& force, const Drive& drive) {
  // A hold that never lets go has no time after it.
  if (!std::isfinite(drive.until)) return std::nullopt;
  // How far it went while it was held is the measure: what is large afterwards depends on how hard
  // was pulled.
  const Range held = range(force, -std::numeric_limits<double>::infinity(), drive.until);
  const Range free =
      // A third of a second later, since a known latency lets the force of the hold go on for
      // nearly as long.
      range(force, drive.until + least_time, std::numeric_limits<double>::infinity());
  const double noise = view.experiment.noise.force_std.value_or(force_noise * held.size);
  if (free.rows < least_rows || free.size < visible * noise) return std::nullopt;
  // A sensor rings a little after a release, and drifts.
  if (free.size < goes_on * held.size) return std::nullopt;
  return Fault{"force.csv", text("goes on to change by %.3g N after the release at %.4g s",
                                 free.size, drive.until) +
                                ": expected no pull any more; another clock, or another trial's "
                                "table?"};
}

class Led {
 public:
  Led(const Track& force, const Drive& drive)
      : force_(force), drive_(drive), stated_(following(force, drive)) {}

  double explained() const { return explained(stated_); }
  /// What another reading of the clock explains; 0 where it sees too little of the path.
  double explained_by(const ClockReading& reading) const {
    const Following f = following(force_, drive_, reading);
    // A clock that sees next to nothing of the path would find a force that follows next to
    // nothing.
    return f.rows < least_rows || f.driven < most_driven * whole() ? 0.0 : explained(f);
  }

 private:
  // A passive plant is pulled along.
  static double explained(const Following& f) {
    // The other sign is no late force but a wrong one: force_check asks that.
    return f.gain.dot(f.along) > 0.0 ? f.explained() : 0.0;
  }
  double whole() const {
    Vec3 mean = Vec3::Zero();
    double square = 0.0;
    const double count = static_cast<double>(drive_.path->position.size());
    for (const Vec3& x : drive_.path->position) mean += x / count;
    for (const Vec3& x : drive_.path->position) square += (x - mean).squaredNorm() / count;
    return std::sqrt(square);
  }

  const Track& force_;
  const Drive& drive_;
  Following stated_;
};

std::optional<Fault> other_unit(const Led& led, const Drive& drive) {
  if (led.explained() > contradicts) return std::nullopt;
  // The force's clock alone: whether the path's is the wrong one the markers say, and were asked
  // before.
  for (const ForceUnit& unit : units)
    if (led.explained_by({0.0, unit.scale}) > agrees)
      return Fault{"force.csv", std::string("seems to have its times in ") + unit.name +
                                    ": the force follows " + drive.path->file.string() +
                                    " when they are " + put_right(unit.scale) +
                                    ", and not as they are" + expected};
  return std::nullopt;
}

std::optional<Fault> late(const Led& led, const Drive& drive) {
  // What follows its path on the clock as it is has no reason to be asked.
  if (led.explained() > agrees) return std::nullopt;
  double best = 0.0, shift = 0.0;
  // Late ones only. A force that is early would be a plant that knows.
  for (double there = least_shift; there < std::min(most_shift, drive.path->time.back());
       there += grid)
    // The first of those that do as well: a drive may repeat itself.
    if (const double explained = led.explained_by({there, 1.0}); explained > best + 0.005) {
      best = explained;
      shift = there;
    }
  // Nearly all, and far more than without a shift. A force that lags by its viscosity gains by a
  // shift, too, but not so much.
  if (best < agrees || 1.0 - best > much_better * (1.0 - led.explained())) return std::nullopt;
  return Fault{"force.csv", text("is %.2g s late: the force follows ", shift) +
                                drive.path->file.string() + " with that shift, and not without" +
                                expected};
}

}  // namespace

std::optional<Fault> check_force_clock(const TrialView& view) {
  const Trial& trial = view.trial;
  if (!view.nominal_plant || trial.force.size() < least_rows || trial.holds.empty() ||
      trial.holds.front().slides())
    return std::nullopt;
  const std::vector<Drive> drives = drives_of(view);
  if (drives.empty() || drives.front().kind != Drive::Kind::hold) return std::nullopt;
  const Drive& drive = drives.front();
  const Track force = force_track(trial);
  const Led led(force, drive);
  // The coarser mistake first. A wrong unit is asked however fast the lead is: nothing follows a
  // thousand times too late.
  if (auto fault = other_unit(led, drive)) return fault;
  // Led fast, mass and damping make a force early or late by themselves.
  if (is_led_slowly(view, drive))
    if (auto fault = late(led, drive)) return fault;
  return after_release(view, force, drive);
}

}  // namespace pedicel::discrepancy
