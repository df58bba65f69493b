#include "plugins/discrepancy/admission/following.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// Of the square of the plant's first frequency, as if all its mass moved with the held point; a
// quarter of it does.
constexpr double slow = 0.4;
constexpr double least_share = 1.0e-3;  // of the drive's main square: below, it has no direction

Drive hold_drive(const TrialView& view, const Hold& hold) {
  const DrivenPath* path = &hold.path;
  // From where it begins, so that an origin that is elsewhere does not matter.
  const Vec3 start = path->position.front();
  return {Drive::Kind::hold, path, view.nominal_plant->spot(hold.place),
          [path, start](double t) { return Vec3(path->position_at(t) - start); }, hold.release};
}

// A point that slides is not held to its path across the axes that it is led along, and what pushes
// it may be anywhere before it touches: such a path leads nothing by itself.
bool leads(const Hold& hold) {
  return !hold.path.time.empty() && !hold.slides();
}

// The root goes with it exactly. A marker near the root does so nearly.
Drive base_drive(const TrialView& view) {
  const DrivenPath* path = &*view.trial.base;
  const Vec3 start = path->position.front();
  // Drawn and settled are the same there: what is clamped does not sag.
  Spot root;
  root.drawn = root.settled = view.nominal_plant->root();
  return {Drive::Kind::base, path, root,
          [path, start](double t) { return Vec3(path->position_at(t) - start); },
          // A base leads the plant to the end of the record.
          std::numeric_limits<double>::infinity()};
}

// A load has a force and no path: a marker beside it follows that, in some direction of its own.
Drive load_drive(const TrialView& view) {
  const std::vector<TimedLoad>* loads = &view.trial.loads;
  const auto force = [loads](double t) {
    Vec3 sum = Vec3::Zero();
    for (const TimedLoad& load : *loads)
      // Up to its end and not at it, as the simulator has it: two loads that follow each other
      // never act at once.
      if (t >= load.from && t < load.to) sum += load.force;
    return sum;
  };
  return {Drive::Kind::load, nullptr, view.nominal_plant->spot(loads->front().place), force,
          std::numeric_limits<double>::infinity()};
}

// 1/s2, of the mean speed of a path over its mean way.
double frequency_square(const DrivenPath& path, double until) {
  Vec3 mean = Vec3::Zero();
  double speed = 0.0, way = 0.0;
  for (const Vec3& x : path.position) mean += x / static_cast<double>(path.position.size());
  for (std::size_t i = 1; i < path.time.size() && path.time[i] <= until; ++i) {
    // By its own rows and times, which need not be even.
    const double dt = path.time[i] - path.time[i - 1];
    speed += (path.position[i] - path.position[i - 1]).squaredNorm() / dt;
    way += dt * (path.position[i] - mean).squaredNorm();
  }
  // Of a sine it is the square of its angular frequency, whatever its size.
  return way > 0.0 ? speed / way : 0.0;
}

bool at_one_place(const std::vector<TimedLoad>& loads) {
  return std::ranges::all_of(loads, [&](const TimedLoad& load) {
    return load.place.curve == loads.front().place.curve && load.place.at == loads.front().place.at;
  });
}

}  // namespace

std::vector<Drive> drives_of(const TrialView& view) {
  std::vector<Drive> drives;
  // What came off no longer leads the plant.
  double broken = std::numeric_limits<double>::infinity();
  // By the first one, whichever fruit it was. Which hold it hung on is not asked: later samples are
  // left out of comparisons as well.
  for (const MeasuredEvent& event : view.trial.events)
    if (event.is_detachment()) broken = std::min(broken, event.time);
  for (const Hold& hold : view.trial.holds) {
    if (!leads(hold)) continue;
    drives.push_back(hold_drive(view, hold));
    // The hand goes on with the fruit, and the plant does not.
    drives.back().until = std::min(drives.back().until, broken);
  }
  // Beside the holds and not in their place. Each is judged by the marker next to it.
  if (view.trial.base && !view.trial.base->time.empty()) drives.push_back(base_drive(view));
  // Several places at once move a marker by a mixture that no one gain tells.
  if (!view.trial.loads.empty() && at_one_place(view.trial.loads))
    drives.push_back(load_drive(view));
  return drives;
}

Track track_of(const Trial& trial, int marker) {
  Track track{marker, {}, {}};
  for (int row = 0; row < trial.markers.size(); ++row) {
    const Vec3 x = trial.markers.value.block<1, 3>(row, 3 * marker).transpose();
    if (!x.allFinite()) continue;
    // Gaps are left out: what follows needs times, and not rows.
    track.time.push_back(trial.markers.time[row]);
    track.place.push_back(x);
  }
  return track;
}

Track force_track(const Trial& trial) {
  Track track;
  for (int row = 0; row < trial.force.size(); ++row) {
    const Vec3 f = trial.force.value.row(row).head<3>().transpose();
    if (!f.allFinite()) continue;
    track.time.push_back(trial.force.time[row]);
    // A force takes the place of a place: what follows a drive is asked alike of both.
    track.place.push_back(f);
  }
  return track;
}

int marker_near(const NominalPlant& nominal_plant, const Spot& spot, double share) {
  int nearest = -1;
  // Along the plant and not through the air: a leaf beside a stem may hang on another branch. Near
  // the root the share of the way would leave no room at all.
  double least = share * std::max(spot.from_root, 0.1 * nominal_plant.reach());
  for (int m = 0; m < static_cast<int>(nominal_plant.markers().size()); ++m) {
    const double way = nominal_plant.along(nominal_plant.markers()[m], spot);
    if (way > least) continue;
    least = way;
    nearest = m;
  }
  return nearest;
}

std::string put_right(double scale) {
  // The scale is what is written over what is meant; a person has to do the opposite.
  return scale < 1.0 ? text("multiplied by %.4g", 1.0 / scale) : text("divided by %.4g", scale);
}

Following following(const Track& track, const Drive& drive, const ClockReading& reading) {
  Following found;
  std::vector<Vec3> u, x;
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    const double t = (track.time[i] - reading.shift) / reading.scale;
    // After the release a marker swings by itself, and follows nothing.
    if ((reading.own_end ? track.time[i] : t) >= drive.until) break;
    // Before its beginning the drive is where it starts.
    u.push_back(drive.value(std::max(t, 0.0)));
    x.push_back(track.place[i]);
  }
  found.rows = static_cast<int>(u.size());
  // Nothing was seen while it was done: then nothing is explained, and no check asks further.
  if (u.empty()) return found;
  // About the means, because a marker's place depends on the plant and the frame; only its change
  // is the drive's.
  Vec3 mean_u = Vec3::Zero(), mean_x = Vec3::Zero();
  for (std::size_t i = 0; i < u.size(); ++i) {
    mean_u += u[i] / found.rows;
    mean_x += x[i] / found.rows;
  }
  Mat3 uu = Mat3::Zero(), xu = Mat3::Zero();
  double xx = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    uu += (u[i] - mean_u) * (u[i] - mean_u).transpose() / found.rows;
    xu += (x[i] - mean_x) * (u[i] - mean_u).transpose() / found.rows;
    xx += (x[i] - mean_x).squaredNorm() / found.rows;
  }
  // In the drive's own directions, which a path along one line has one of. The inverse of its
  // covariance would be made of noise across that line.
  const Eigen::SelfAdjointEigenSolver<Mat3> main(uu);
  double left = xx;
  for (int i = 0; i < 3; ++i) {
    const double square = main.eigenvalues()[i];
    // What does not move at all has no direction either.
    if (!(square > least_share * main.eigenvalues()[2]) || square <= 0.0) continue;
    const Vec3 direction = main.eigenvectors().col(i);
    // Each direction explains its own part of the square, since they are not correlated.
    left -= (xu * direction).squaredNorm() / square;
    // Eigenvalues rise, so the last one that counts is the main one.
    found.along = direction;
    found.gain = xu * direction / square;
  }
  found.driven = std::sqrt(uu.trace());
  found.moved = std::sqrt(xx);
  // By rounding it may be a little less than nothing.
  found.left = std::sqrt(std::max(left, 0.0));
  return found;
}

bool is_led_slowly(const TrialView& view, const Drive& drive) {
  // The softest way of the point and the whole mass give the lowest frequency that the plant may
  // have there. The trace is more than the softest, so the error is towards calling a drive fast,
  // and of such a one less is judged.
  const double compliance = view.nominal_plant->compliance(drive.spot).trace();
  return frequency_square(*drive.path, drive.until) * compliance * view.nominal_plant->mass() <=
         slow;
}

double noise_of_markers(const TrialView& view) {
  return view.experiment.noise.position_std.value_or(scatter_of_markers(view.trial));
}

double scatter_of_markers(const Trial& trial) {
  // From the cubic through two neighbours on either side, whose square is 70/36 of the noise's.
  std::vector<double> distances;
  const Eigen::MatrixXd& value = trial.markers.value;
  for (Eigen::Index c = 0; c < value.cols(); ++c)
    for (Eigen::Index i = 2; i + 2 < value.rows(); ++i) {
      const double d =
          value(i, c) -
          (4.0 * (value(i - 1, c) + value(i + 1, c)) - (value(i - 2, c) + value(i + 2, c))) / 6.0;
      // By the median, as outliers are still in. 1.4826 makes a deviation of it where noise is
      // normal.
      if (std::isfinite(d)) distances.push_back(std::abs(d));
    }
  return distances.empty() ? 0.0 : 1.4826 * median_of(distances) / std::sqrt(70.0 / 36.0);
}

}  // namespace pedicel::discrepancy
