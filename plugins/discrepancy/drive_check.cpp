// What is done and what is seen of it. A marker beside a held point, a root or a load moves when
// that is moved, the same way, and no later than a latency of 0.3 s. No plant moves before anything
// is done.
#include <algorithm>
#include <cmath>

#include "discrepancy/following.h"
#include "discrepancy/sentence.h"
#include "discrepancy/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

constexpr double beside = 0.3;  // of the way from the root to what is done, along the plant
constexpr int least_rows = 8;
constexpr double visible = 10.0;  // times the noise, rms
// As stated the drive explains less than half of the motion; read otherwise, nine tenths of it.
constexpr double contradicts = 0.5, agrees = 0.9;
// Or it explains more, but another clock leaves a quarter of what is left of the motion's square.
constexpr double much_better = 0.25;
constexpr double least_shift = 0.5;  // s: a latency of 0.3 s, and 0.2 s for a slow plant to follow
constexpr double grid = 0.05;        // s, of shifts
constexpr int most_shifts = 1500;
constexpr double whole = 0.5;  // of the drive's motion must be seen under another reading
// A metre of the held point moves a marker beside it by this much: softer grips are not known.
constexpr double least_gain = 0.03, most_gain = 5.0;
constexpr double same_way = 0.7;  // the cosine: a frame turned by 0.3 rad, and a stem's own lean

struct ClockUnit {
  const char* name;
  double scale;
};
constexpr ClockUnit clock_units[] = {
    {"milliseconds", 1e3}, {"microseconds", 1e6}, {"minutes", 1.0 / 60.0}};

/// One drive and the marker beside it.
class Beside {
 public:
  Beside(const TrialView& view, const Drive& drive, int marker, double noise)
      : view_(view), drive_(drive), noise_(noise), track_(track_of(view.trial, marker)) {
    stated_ = following(track_, drive_);
    // All that is done while the trial lasts.
    Drive all = drive_;
    Track times = track_;
    whole_ = following(times, all, {0.0, 1.0, true}).driven;
  }

  std::optional<Fault> fault() const {
    if (static_cast<int>(track_.time.size()) < least_rows) return std::nullopt;
    if (auto found = unit_of_clock()) return found;
    if (auto found = shifted()) return found;
    return std::nullopt;
  }

 private:
  double explained(const Following& f) const {
    if (f.rows < least_rows || f.driven <= 0.0 || f.moved < visible * noise_) return 0.0;
    const double gain = f.gain.dot(f.along);
    // What is moved moves its neighbour the same way; a load may move it askew.
    const bool is_load = drive_.kind == Drive::Kind::load;
    if (gain < (is_load ? 0.0 : same_way) * f.gain.norm()) return 0.0;
    if (!is_load && (gain > most_gain || gain < least_gain)) return 0.0;
    return std::max(0.0, f.explained());
  }

  std::string name() const { return view_.experiment.markers[track_.marker].name; }
  std::string drive_name() const {
    return drive_.kind == Drive::Kind::load ? "the load" : drive_.file.string();
  }

  // Whether the marker's clock, or the path's, ticks in another unit.
  std::optional<Fault> unit_of_clock() const {
    if (explained(stated_) > contradicts) return std::nullopt;
    std::vector<ClockUnit> units(std::begin(clock_units), std::end(clock_units));
    const double step = drive_.file.empty() ? 0.0 : path_step();
    if (step > 0.0) units.push_back({"numbers of frames", 1.0 / step});
    for (const ClockUnit& unit : units) {
      for (const bool path : {false, true}) {
        const double scale = path ? 1.0 / unit.scale : unit.scale;
        if (path && drive_.file.empty()) continue;
        const Following other = following(track_, drive_, {0.0, scale, path});
        if (explained(other) < agrees || other.driven < whole * full()) continue;
        return Fault{path ? drive_.file : "markers.csv",
                     std::string("has times in ") + unit.name + ", it seems: " + name() +
                         " follows " + drive_name() +
                         text(" when they are divided by %.4g, and not as they are",
                              path ? unit.scale : unit.scale) +
                         ": expected seconds since the trial began"};
      }
    }
    return std::nullopt;
  }

  double path_step() const {
    for (const TableClock& clock : clocks_of(view_.trial))
      if (clock.file == drive_.file) return clock.step;
    return 0.0;
  }

  // The rms of the whole drive, as if the marker had seen all of it.
  double full() const {
    if (drive_.kind == Drive::Kind::load) return whole_;
    const Path& path = drive_path();
    Vec3 mean = Vec3::Zero();
    double square = 0.0;
    for (const Vec3& x : path.position) mean += x / static_cast<double>(path.position.size());
    for (const Vec3& x : path.position) square += (x - mean).squaredNorm();
    return std::sqrt(square / static_cast<double>(path.position.size()));
  }
  const Path& drive_path() const {
    for (const Hold& hold : view_.trial.holds)
      if (hold.path.file == drive_.file) return hold.path;
    return *view_.trial.base;
  }

  std::optional<Fault> shifted() const {
    const double as_stated = explained(stated_);
    if (as_stated > agrees || track_.time.empty()) return std::nullopt;
    const ClockReading best = best_shift();
    const double most = explained(following(track_, drive_, best));
    if (std::abs(best.shift) < least_shift || most < agrees) return std::nullopt;
    if (1.0 - most > much_better * (1.0 - as_stated)) return std::nullopt;
    if (best.shift > 0.0 && !rests_until(best.shift)) return std::nullopt;
    return Fault{"markers.csv",
                 "is " + text("%.2g s ", std::abs(best.shift)) +
                     (best.shift > 0.0 ? "late" : "early") + ": " + name() + " follows " +
                     drive_name() + " with that shift, and not without" +
                     ": expected one clock for all tables of a trial, but for a latency below " +
                     text("%.2g s", largest_known::latency)};
  }

  // The smallest of those that explain nearly as much as any: a drive may repeat itself.
  ClockReading best_shift() const {
    std::vector<std::pair<double, double>> left;  // shift, share that is not explained
    const double last = track_.time.back();
    for (int i = 0; i < most_shifts; ++i) {
      const double shift = -std::min(last, 0.5 * grid * most_shifts) + grid * i;
      if (shift > last) break;
      const Following other = following(track_, drive_, {shift, 1.0});
      if (other.driven >= whole * full()) left.push_back({shift, 1.0 - explained(other)});
    }
    if (left.empty()) return {};
    double least = 1.0;
    for (const auto& [shift, share] : left) least = std::min(least, share);
    ClockReading best{1.0e300, 1.0};
    for (const auto& [shift, share] : left)
      if (share <= 1.5 * least + 0.005 && std::abs(shift) < std::abs(best.shift))
        best.shift = shift;
    return best;
  }

  // A slow plant follows late, but it begins at once.
  bool rests_until(double shift) const {
    const double begins = drive_times(view_.trial).first;
    double before = 0.0, all = 0.0;
    for (std::size_t i = 0; i < track_.time.size(); ++i) {
      const double way = (track_.place[i] - track_.place.front()).norm();
      all = std::max(all, way);
      if (track_.time[i] < begins + 0.7 * shift) before = std::max(before, way);
    }
    return before < 0.1 * all + 6.0 * noise_;
  }

  const TrialView& view_;
  const Drive& drive_;
  double noise_;
  Track track_;
  Following stated_;
  double whole_ = 0.0;
};

}  // namespace

std::optional<Fault> check_drive(const TrialView& view) {
  if (!view.layout) return std::nullopt;
  const double noise = noise_of_markers(view);
  for (const Drive& drive : drives_of(view)) {
    const int marker = marker_near(*view.layout, drive.spot, beside);
    if (marker < 0) continue;
    if (auto fault = Beside(view, drive, marker, noise).fault()) return fault;
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
