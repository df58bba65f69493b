// Jumps. What swings freely does not go far between two samples where it goes little before and
// after. Frames that were dropped while the clock counted on do.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

// Against what it does right there. A fast swing has long steps, but they are long on both sides.
constexpr double far = 3.0;  // times the longest of the two steps before and after
// As for steps of the frame: every row is asked, and noise must never reach it.
constexpr double visible = 15.0;  // times the noise
constexpr double smooth = 0.6;    // by which two steps that follow each other may differ
constexpr double even = 1.2;      // of the clock's steps
constexpr double after = 0.1;     // s, from the last that is done on

Vec3 step(const Samples& samples, int row, int m) {
  return (samples.value.block<1, 3>(row, 3 * m) - samples.value.block<1, 3>(row - 1, 3 * m))
      .transpose();
}

bool jumps(const Samples& samples, int row, int m, double noise) {
  const Vec3 here = step(samples, row, m);
  double longest = 0.0;
  for (const int side : {-1, 1}) {
    // Two steps on either side, which must be alike: where the motion is not smooth at this rate, a
    // jump says nothing.
    const Vec3 next = step(samples, row + side, m), second = step(samples, row + 2 * side, m);
    const double most = std::max(next.norm(), second.norm());
    // Seldom sampled, any motion jumps.
    if (!((next - second).norm() < smooth * most + 6.0 * noise)) return false;
    longest = std::max(longest, most);
  }
  return here.norm() > far * longest && here.norm() > visible * noise;
}

}  // namespace

std::optional<Fault> check_jumps(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  const DriveTimes drive = drive_times(view.trial);
  // Something that acts to the end may jerk the plant at any time.
  if (!drive.over) return std::nullopt;
  const double noise = noise_of_markers(view);
  const double usual = clock_of({}, samples.time).step;
  const int markers = static_cast<int>(view.experiment.markers.size());
  for (int row = 3; row + 2 < samples.size(); ++row) {
    // A plant that was just let go starts within a sample. The first of the six rows counts, as all
    // of them are judged.
    if (drive.any && samples.time[row - 3] < drive.last + after) continue;
    // Where the clock shows the gap, everything is as it says.
    if (samples.time[row] - samples.time[row - 1] > even * usual) continue;
    int seen = 0, jumping = 0;
    for (int m = 0; m < markers; ++m) {
      // Of a marker that was hidden in between the steps are those of several rows.
      if (!samples.value.block(row - 3, 3 * m, 6, 3).allFinite()) continue;
      ++seen;
      jumping += jumps(samples, row, m, noise) ? 1 : 0;
    }
    // More than half of them. One that jumps was touched or mislabelled, which others ask; dropped
    // frames move all, but those near the clamp by too little to see.
    if (jumping == 0 || 2 * jumping <= seen) continue;
    return Fault{
        "markers.csv",
        "has " + std::to_string(jumping) + " of " + std::to_string(seen) +
            text(" markers jump between %.4g and %.4g s, where the plant swings freely",
                 samples.time[row - 1], samples.time[row]) +
            ": expected the time of each frame; frames dropped, and the clock counted on?"};
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
