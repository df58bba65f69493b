// Releases. What is held rests or goes where it is led; let go, it swings at once. A release is
// stated to a latency, and to the few samples that a hand takes to open.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/beside.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

constexpr double least_time = 0.5;  // s: a latency of 0.3 s, and 0.2 s
constexpr double left_behind =
    0.03;                           // of the reach: a grip that slips moves what is beside it less
constexpr double left_share = 0.3;  // of the way that the point was led
constexpr double is_still = 0.1;    // of the way that it goes later
constexpr double visible = 20.0;    // times the noise
constexpr double still_path = 0.003;  // of the reach, or 0.02 of its way: a path that rests
// Fewer samples may be outliers.
constexpr int least_rows = 5;

/// Samples of a track between two times.
struct Stretch {
  int rows = 0;
  double rms = 0.0, most = 0.0;  // m, from a place
};
Stretch away(const Track& track, const Vec3& place, double from, double to) {
  Stretch stretch;
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    if (track.time[i] < from || track.time[i] >= to) continue;
    const double way = (track.place[i] - place).norm();
    stretch.rms += way * way;
    stretch.most = std::max(stretch.most, way);
    ++stretch.rows;
  }
  stretch.rms = std::sqrt(stretch.rms / std::max(stretch.rows, 1));
  return stretch;
}

// The last place before a time; NaN where there is none.
Vec3 place_at(const Track& track, double time) {
  // Not between two samples: what is held rests, and so its last place is its place.
  Vec3 last = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < track.time.size() && track.time[i] <= time; ++i)
    last = track.place[i];
  return last;
}

// From when on a path rests at its end.
double rests_from(const DrivenPath& path, double reach) {
  double way = 0.0;
  for (const Vec3& x : path.position) way = std::max(way, (x - path.position.front()).norm());
  // Hands tremble, and trackers of hands have noise.
  const double least = std::max(still_path * reach, 0.02 * way);
  std::size_t row = path.position.size() - 1;
  while (row > 0 && (path.position[row - 1] - path.position.back()).norm() < least) --row;
  return path.time[row];
}

// A hold without an end is let go by nobody, and a base or a load is no hold.
bool is_released(const Beside& beside) {
  return beside.drive().kind == Drive::Kind::hold && std::isfinite(beside.drive().until);
}

// Held at the end of its path, the point rests, and what is beside it as well.
std::optional<Fault> leaves_early(const Beside& beside) {
  const Drive& drive = beside.drive();
  const double reach = beside.view().nominal_plant->reach();
  // From where the path rests, and not from its last row: many paths go on telling the same place.
  const double end = rests_from(*drive.path, reach);
  // A path that ends at its release has no time of rest to be judged in.
  if (drive.until - end < least_time) return std::nullopt;
  // By the part that is surely led. What follows may be a swing, and would spoil the gain.
  Drive known = drive;
  known.until = end;
  // How far the marker went by being led, as it did so: what it leaves by is told against that.
  const double led = drive.value(end).norm() * following(beside.track(), known).gain.norm();
  const Vec3 last = place_at(beside.track(), end);
  if (!last.allFinite()) return std::nullopt;
  const Stretch held = away(beside.track(), last, end, drive.until);
  // The largest of the three: a grip that slips, a part of the way that it was led, and noise are
  // all no release.
  const double limit = std::max({left_behind * reach, left_share * led, visible * beside.noise()});
  // The mean square over the rest and not the farthest sample: a swing that dies out at the end of
  // a fast path goes far for a short time.
  if (held.rows < least_rows || held.rms < limit) return std::nullopt;
  return Fault{"markers.csv",
               "has " + beside.marker() +
                   text(" leave its place by up to %.3g mm after %.3g s", 1e3 * held.most, end) +
                   text(", where the point beside it is held until %.3g s: expected it to rest; a "
                        "release that was earlier, or a clock that is early?",
                        drive.until)};
}

// It is led on, and goes along.
std::optional<Fault> follows_on(const Beside& beside) {
  const Drive& drive = beside.drive();
  const double end = drive.path->time.back(), reach = beside.view().nominal_plant->reach();
  if (end - drive.until < least_time) return std::nullopt;
  // As if it had been held to the end of its path. If that explains what it does after its release,
  // it was.
  Drive longer = drive;
  longer.until = end;
  // Nearly all of it: a free swing may look like a part of any path.
  if (beside.explained_by(longer) < 0.98) return std::nullopt;
  // And it must be away from where it began, because a plant let go at its rest follows a path that
  // rests.
  const Stretch after = away(beside.track(), beside.track().place.front(), drive.until, end);
  if (after.rows < least_rows || after.most < left_behind * reach) return std::nullopt;
  return Fault{"markers.csv", "has " + beside.marker() + " follow " + beside.what() +
                                  text(" until %.3g s, where it is let go at %.3g s: expected it "
                                       "to swing from then on; a release that was later, or the "
                                       "tables of another trial?",
                                       end, drive.until)};
}

std::string likely_clock(const Beside& beside, double begins) {
  const double ratio = begins / beside.drive().until;
  const double step = clock_of({}, beside.drive().path->time).step;
  // When it is seen over when it is stated is the factor of the unit.
  const auto is_near = [&](double unit) { return std::abs(std::log(ratio / unit)) < 0.1; };
  if (is_near(1e3)) return "; times in milliseconds?";
  if (step > 0.0 && 1.0 / step > 5.0 && is_near(1.0 / step)) return "; numbers of frames?";
  return "; a clock that is late, or a release that was later?";
}

// It stays where it is, and goes much later: what has come to rest does not begin by itself.
std::optional<Fault> leaves_late(const Beside& beside) {
  const Drive& drive = beside.drive();
  const Track& track = beside.track();
  Vec3 held = place_at(track, drive.until);
  // A record that begins at its release has no place before it.
  if (!held.allFinite()) held = track.place.front();
  const double infinity = std::numeric_limits<double>::infinity();
  // How far it goes at all after the release tells what its beginning has to be measured against.
  const double most = away(track, held, drive.until, infinity).most;
  // A plant that was let go where it rests has no reason to move.
  if (most < std::max(left_behind * beside.view().nominal_plant->reach(), visible * beside.noise()))
    return std::nullopt;
  double begins = infinity;
  // From the end backwards, so that the earliest one is left.
  for (std::size_t i = track.time.size(); i-- > 0 && track.time[i] >= drive.until;)
    if ((track.place[i] - held).norm() > is_still * most) begins = track.time[i];
  // It must have been seen to rest in between: a gap over the release looks the same.
  if (begins - drive.until < least_time || away(track, held, drive.until, begins).rows < least_rows)
    return std::nullopt;
  return Fault{"markers.csv",
               "has " + beside.marker() +
                   text(" begin to move at %.4g s, where it is let go at %.3g s: expected it to "
                        "swing from then on",
                        begins, drive.until) +
                   likely_clock(beside, begins)};
}

// Nearly all of a path lies after its release.
std::optional<Fault> path_of_another_clock(const Beside& beside) {
  const DrivenPath& path = *beside.drive().path;
  const double until = beside.drive().until;
  const auto before = std::ranges::count_if(path.time, [&](double t) { return t < until; });
  // A path may go on after its release, as a hand does, but it is not told for twenty times as long
  // with nothing before.
  if (path.time.size() < 10 || before > 2 || path.time.back() < 20.0 * until) return std::nullopt;
  return Fault{path.file, "has " + std::to_string(before) + " of " +
                              std::to_string(path.time.size()) + " rows before the release at " +
                              text("%.3g s, and lasts until %.4g s: expected seconds since the "
                                   "trial began",
                                   until, path.time.back()) +
                              "; times in milliseconds, or numbers of frames?"};
}

}  // namespace

std::optional<Fault> check_releases(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  for (const Beside& beside : Beside::all_of(view)) {
    if (!is_released(beside)) continue;
    // A path on another clock first: the others would blame the marker for it.
    for (const auto check : {path_of_another_clock, leaves_late, leaves_early, follows_on})
      if (auto fault = check(beside)) return fault;
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
