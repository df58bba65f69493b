// Jumps. What swings freely does not go far between two samples where it goes little before and
// after. Frames that were dropped while the clock counted on do.
#include <algorithm>
#include <cmath>

#include "pedicel/discrepancy/admission/first_places.h"
#include "pedicel/discrepancy/admission/following.h"
#include "pedicel/discrepancy/data/sentence.h"
#include "pedicel/discrepancy/data/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

constexpr double far = 3.0;       // times the longest of the two steps before and after
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
  if (!drive.over) return std::nullopt;
  const double noise = noise_of_markers(view);
  const double usual = clock_of({}, samples.time).step;
  const int markers = static_cast<int>(view.experiment.markers.size());
  for (int row = 3; row + 2 < samples.size(); ++row) {
    if (drive.any && samples.time[row - 3] < drive.last + after) continue;
    if (samples.time[row] - samples.time[row - 1] > even * usual) continue;
    int seen = 0, jumping = 0;
    for (int m = 0; m < markers; ++m) {
      if (!samples.value.block(row - 3, 3 * m, 6, 3).allFinite()) continue;
      ++seen;
      jumping += jumps(samples, row, m, noise) ? 1 : 0;
    }
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
