#include "plugins/discrepancy/admission/beside.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr double near = 0.3;  // of the way from the root to what is done, along the plant
// A fit of three directions to fewer rows explains nearly anything.
constexpr int least_rows = 8;
// Noise is explained by nothing. Below this a marker that rests would look like one that goes
// another way.
constexpr double visible = 10.0;  // times the noise, rms
// A metre of the held point moves a marker beside it by this much: softer grips are not known.
constexpr double least_gain = 0.03, most_gain = 5.0;
constexpr double same_way = 0.7;  // the cosine: a frame turned by 0.3 rad, and a stem's own lean

double whole_of(const Track& track, const Drive& drive) {
  // A whole is needed to tell a clock that sees the drive from one that sees a quiet part of it.
  if (drive.kind == Drive::Kind::load) {
    Drive all = drive;
    // Of a load, its whole course: it acts through a force, which has no end of its own.
    all.until = std::numeric_limits<double>::infinity();
    return following(track, all).driven;
  }
  // Of the path's own rows, whatever the marker's clock says: a wrong clock may see a part of it
  // only, and that part would then look like the whole.
  Vec3 mean = Vec3::Zero();
  double square = 0.0;
  const double count = static_cast<double>(drive.path->position.size());
  for (const Vec3& x : drive.path->position) mean += x / count;
  for (const Vec3& x : drive.path->position) square += (x - mean).squaredNorm() / count;
  return std::sqrt(square);
}

}  // namespace

std::vector<Beside> Beside::all_of(const TrialView& view) {
  std::vector<Beside> all;
  // Once, because it is read from all markers of the trial.
  const double noise = noise_of_markers(view);
  for (const Drive& drive : drives_of(view)) {
    const int marker = marker_near(*view.nominal_plant, drive.spot, near);
    // Too far away, a marker follows the plant and not the drive.
    if (marker < 0) continue;
    Beside one(view, drive, marker, noise);
    // A marker that was hardly seen says nothing, neither for nor against.
    if (static_cast<int>(one.track_.time.size()) >= least_rows) all.push_back(std::move(one));
  }
  return all;
}

Beside::Beside(const TrialView& view, Drive drive, int marker, double noise)
    : view_(&view),
      drive_(std::move(drive)),
      noise_(noise),
      track_(track_of(view.trial, marker)),
      whole_(whole_of(track_, drive_)) {}

const std::string& Beside::marker() const {
  return view_->experiment.markers[track_.marker].name;
}

// By the file's name, where there is one: that is where a person has to look.
std::string Beside::what() const {
  return drive_.kind == Drive::Kind::load ? "the load" : drive_.path->file.string();
}

Following Beside::follow(const ClockReading& reading) const {
  return following(track_, drive_, reading);
}

double Beside::explained(const ClockReading& reading) const {
  return valid(follow(reading), drive_);
}

double Beside::explained_by(const Drive& other) const {
  return valid(following(track_, other), other);
}

double Beside::valid(const Following& f, const Drive& drive) const {
  // Where it cannot be said it explains nothing: a check then has no fault to tell.
  if (f.rows < least_rows || f.driven <= 0.0 || f.moved < visible * noise_) return 0.0;
  // Explained is not enough: a marker that goes across, or ten times as far, may still be a linear
  // function of the drive, and no neighbour does that.
  const double gain = f.gain.dot(f.along);
  // What is moved moves its neighbour the same way; a load may move it askew.
  const bool is_load = drive.kind == Drive::Kind::load;
  if (gain < (is_load ? 0.0 : same_way) * f.gain.norm()) return 0.0;
  // What a newton moves depends on the plant, so a load's gain has no bounds of its own.
  if (!is_load && (gain > most_gain || gain < least_gain)) return 0.0;
  return std::max(0.0, f.explained());
}

}  // namespace pedicel::discrepancy
