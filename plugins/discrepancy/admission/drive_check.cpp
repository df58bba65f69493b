// Clocks against what is done. A marker beside a held point, a root or a load goes along with it,
// no later than a latency of 0.3 s. No plant moves before anything is done.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/beside.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

// As stated the drive explains less than half of the motion; with another clock, nine tenths.
constexpr double contradicts = 0.5, agrees = 0.9;
// Or it explains more, but another clock leaves a quarter of what is left of the motion's square.
constexpr double much_better = 0.25;
// Shorter shifts than this may be a latency and a plant that is slow to follow, both of which are
// findings.
constexpr double least_shift = 0.5;  // s: a latency of 0.3 s, and 0.2 s for a slow plant to follow
constexpr double grid = 0.05;        // s, of shifts
constexpr int most_shifts = 1500;
constexpr double most = 0.5;  // of the drive's motion must be seen with the other clock
// Rates by the per cent: a clock that is off by less is asked by rate_check.
constexpr double rate_grid = 0.01, slowest = 0.5, fastest = 2.0;

struct ClockUnit {
  const char* name;
  double scale;
};
// What tables of recorders are written in.
constexpr ClockUnit clock_units[] = {{"milliseconds", 1e3},
                                     {"microseconds", 1e6},
                                     {"minutes", 1.0 / 60.0},
                                     {"kiloseconds", 1e-3},
                                     {"hours", 1.0 / 3600.0}};

const std::string expected = ": expected seconds since the trial began, the same in all its tables";

// Of the path alone. A load has no rows, so nothing could be counted by it.
double step_of(const Beside& beside) {
  return beside.drive().path ? clock_of({}, beside.drive().path->time).step : 0.0;
}

// Whether the marker's clock, or the path's, ticks in another unit.
std::optional<Fault> other_unit(const Beside& beside) {
  // A unit is wrong by a factor, and then nothing fits: what fits at all is not asked.
  if (beside.explained() > contradicts) return std::nullopt;
  std::vector<ClockUnit> units(std::begin(clock_units), std::end(clock_units));
  // Frames are counted by the drive's own step.
  if (step_of(beside) > 0.0) units.push_back({"numbers of frames", 1.0 / step_of(beside)});
  for (const ClockUnit& unit : units)
    // Either of the two tables may be the wrong one. The marker's is, more often, as it comes from
    // another machine.
    for (const bool path : {false, true}) {
      if (path && !beside.drive().path) continue;
      // A path in another unit is as if the marker's clock were in the inverse of it. But its hold
      // then ends by the marker's own time, which is right.
      const ClockReading reading{0.0, path ? 1.0 / unit.scale : unit.scale, path};
      if (beside.explained(reading) < agrees ||
          // Enough of the drive must be seen by the other clock, or the marker follows a stretch in
          // which nothing is done.
          beside.follow(reading).driven < most * beside.whole())
        continue;
      return Fault{path ? beside.drive().path->file : "markers.csv",
                   std::string("seems to have its times in ") + unit.name + ": " + beside.marker() +
                       " follows " + beside.what() + " when they are " + put_right(unit.scale) +
                       ", and not as they are" + expected};
    }
  return std::nullopt;
}

struct Candidate {
  ClockReading reading;
  double left = 1.0;  // share of the motion that is not explained
};

void consider(const Beside& beside, const ClockReading& reading, std::vector<Candidate>& all) {
  // A clock under which the marker sees the drive at rest explains everything, as nothing moves.
  if (beside.follow(reading).driven >= most * beside.whole())
    all.push_back({reading, 1.0 - beside.explained(reading)});
}

// Of those that leave nearly as little as any the one nearest to what is stated: a drive may repeat
// itself.
template <class Size>
Candidate nearest_of_best(const std::vector<Candidate>& all, const Size& size) {
  double least = 1.0;
  for (const Candidate& one : all) least = std::min(least, one.left);
  Candidate best;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Candidate& one : all) {
    // Half as much again, and half a percent for drives that leave nearly nothing.
    if (one.left > 1.5 * least + 0.005 || size(one.reading) >= smallest) continue;
    smallest = size(one.reading);
    best = one;
  }
  return best;
}

bool is_better(const Candidate& found, const Beside& beside) {
  // Both: it explains nearly all, and far more than the clock that is stated.
  return 1.0 - found.left >= agrees && found.left <= much_better * (1.0 - beside.explained());
}

// A slow plant follows late, but it begins at once.
bool rests_until(const Beside& beside, double shift) {
  const double begins = drive_times(beside.view().trial).first;
  const Track& track = beside.track();
  double before = 0.0, all = 0.0;
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    const double way = (track.place[i] - track.place.front()).norm();
    all = std::max(all, way);
    // Less than the whole shift, which is known to a step of the grid.
    if (track.time[i] < begins + 0.7 * shift) before = std::max(before, way);
  }
  // A tenth: nothing rests quite.
  return before < 0.1 * all + 6.0 * beside.noise();
}

// Whether the marker goes some way while the path still holds it at its first place.
bool moves_before(const Beside& beside) {
  const Drive& drive = beside.drive();
  const DrivenPath& path = *drive.path;
  double whole = 0.0;
  for (const Vec3& x : path.position) whole = std::max(whole, (x - path.position.front()).norm());
  std::size_t row = 0;
  // To where the path has left its first place by a fiftieth: a hand that waits trembles.
  while (row + 1 < path.time.size() &&
         (path.position[row + 1] - path.position.front()).norm() < 0.02 * whole)
    ++row;
  const Track& track = beside.track();
  double before = 0.0, all = 0.0;
  for (std::size_t i = 0; i < track.time.size() && track.time[i] < drive.until; ++i) {
    const double way = (track.place[i] - track.place.front()).norm();
    all = std::max(all, way);
    if (track.time[i] < path.time[row]) before = std::max(before, way);
  }
  return before > 0.1 * all + 10.0 * beside.noise();
}

// A path that leads the point later than it goes. No latency does so: what is held does not move
// before it is led.
std::optional<Fault> late_path(const Beside& beside) {
  const Drive& drive = beside.drive();
  // A base shakes the whole plant, and a load may be what has just been taken off.
  if (drive.kind != Drive::Kind::hold || beside.explained() > agrees) return std::nullopt;
  std::vector<Candidate> all;
  // The grid is fine against the least shift that is told.
  const double last = std::min(drive.path->time.back(), 0.5 * grid * most_shifts);
  for (int i = 1; grid * i <= last; ++i) consider(beside, {-grid * i, 1.0, true}, all);
  const Candidate best =
      nearest_of_best(all, [](const ClockReading& r) { return std::abs(r.shift); });
  const double shift = -best.reading.shift;
  // A latency is a finding of the diagnosis, and no contradiction.
  if (shift <= largest_known::latency || !is_better(best, beside) || !moves_before(beside))
    return std::nullopt;
  return Fault{drive.path->file, text("is %.2g s late: ", shift) + beside.marker() +
                                     " moves before it, and follows it with that shift" + expected};
}

std::optional<Fault> shifted(const Beside& beside) {
  if (beside.explained() > agrees) return std::nullopt;
  std::vector<Candidate> all;
  const double last = beside.track().time.back();
  for (int i = 0; i < most_shifts; ++i) {
    const double shift = -std::min(last, 0.5 * grid * most_shifts) + grid * i;
    if (shift > last) break;
    consider(beside, {shift, 1.0}, all);
  }
  const Candidate best =
      nearest_of_best(all, [](const ClockReading& r) { return std::abs(r.shift); });
  const double shift = best.reading.shift;
  // Both ways, since the marker's table may be the one that is early.
  if (std::abs(shift) < least_shift || !is_better(best, beside)) return std::nullopt;
  // Of a drive that repeats itself a shift by a period explains as much.
  if (shift > 0.0 && !rests_until(beside, shift)) return std::nullopt;
  return Fault{"markers.csv", "is " + text("%.2g s ", std::abs(shift)) +
                                  (shift > 0.0 ? "late" : "early") + ": " + beside.marker() +
                                  " follows " + beside.what() +
                                  " with that shift, and not without" + expected +
                                  text(", but for a latency below %.2g s", largest_known::latency)};
}

// A rate of frames that is not the stated one: by the end the clocks are apart.
std::optional<Fault> other_rate(const Beside& beside) {
  if (!beside.drive().path) return std::nullopt;  // loads: load_check
  const double end = std::min(beside.track().time.back(), beside.drive().until);
  std::vector<Candidate> all;
  // From half to twice as fast: rates of cameras and drives are mixed up by small factors. Larger
  // ones are units.
  const int rates = static_cast<int>(std::lround((fastest - slowest) / rate_grid));
  for (int i = 0; i <= rates; ++i) consider(beside, {0.0, slowest + rate_grid * i}, all);
  const Candidate best =
      nearest_of_best(all, [](const ClockReading& r) { return std::abs(std::log(r.scale)); });
  // What counts is how far the clocks are apart by the end: a percent of a short trial is nothing.
  const double apart = std::abs(1.0 - 1.0 / best.reading.scale) * end;
  if (apart < least_shift || !is_better(best, beside)) return std::nullopt;
  return Fault{"markers.csv",
               text("has a clock that runs %.3g times as fast as that of ", best.reading.scale) +
                   beside.what() + ": " + beside.marker() + " follows it that way" +
                   text(", and is %.2g s off by the end as it is", apart) + expected +
                   "; another rate of frames?"};
}

}  // namespace

std::optional<Fault> check_drive(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  for (const Beside& beside : Beside::all_of(view))
    // The coarser mistake first: under a wrong unit every shift looks wrong.
    for (const auto check : {other_unit, other_rate, late_path, shifted})
      if (auto fault = check(beside)) return fault;
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
