#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plugins/discrepancy/admission/contradiction_checks.h"

namespace pedicel::discrepancy {

/// What is done to the plant at one place, as the trial states it: the displacement of a held point
/// or of the root (m), or the force of loads (N).
struct Drive {
  enum class Kind { hold, base, load };
  Kind kind = Kind::hold;
  const DrivenPath* path = nullptr;  ///< of the trial; null: it has none
  Spot spot;                         ///< where it acts
  std::function<Vec3(double t)> value;
  double until = 0.0;  ///< s: when a hold ends
};
std::vector<Drive> drives_of(const TrialView& view);

/// The samples of one marker that were seen.
struct Track {
  int marker = 0;
  std::vector<double> time;  ///< s
  std::vector<Vec3> place;   ///< m, W
};
Track track_of(const Trial& trial, int marker);
/// The same of the measured force, N in place of m.
Track force_track(const Trial& trial);

/// The marker that is nearest to a place along the plant, up to a share of its way from the root;
/// -1: there is none.
int marker_near(const NominalPlant& nominal_plant, const Spot& spot, double share);

/// Another reading of the clocks: a sample at t saw what the drive did at (t - shift) / scale. A
/// hold ends by that time, too, unless `own_end`.
struct ClockReading {
  double shift = 0.0, scale = 1.0;  // s, 1
  bool own_end = false;
};

/// What is to be done to times that were scaled: "divided by 1000", "multiplied by 60".
std::string put_right(double scale);

/// A marker's motion as a linear function of what is done beside it at the same time, while it is
/// done. Slow motions of a rod are that, fast ones nearly.
struct Following {
  int rows = 0;
  double driven = 0.0;        ///< rms of the drive about its mean, m or N
  double moved = 0.0;         ///< m, rms of the marker about its mean
  double left = 0.0;          ///< m, rms of what the drive does not explain
  Vec3 along = Vec3::Zero();  ///< the drive's main direction
  Vec3 gain = Vec3::Zero();   ///< by how much the marker moves for one along it

  double explained() const { return moved > 0.0 ? 1.0 - left * left / (moved * moved) : 0.0; }
};
Following following(const Track& track, const Drive& drive, const ClockReading& reading = {});

/// Whether a path leads the plant so slowly that it pulls back like a spring. False where nothing
/// is known of its stiffness.
bool is_led_slowly(const TrialView& view, const Drive& drive);

/// m: the noise of the markers, as stated or as neighbouring samples scatter.
double noise_of_markers(const TrialView& view);
/// m: how neighbouring samples scatter.
double scatter_of_markers(const Trial& trial);

}  // namespace pedicel::discrepancy
