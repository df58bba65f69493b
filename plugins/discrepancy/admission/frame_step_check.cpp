// Steps of the frame. All markers go aside by the same from one sample to the next, and on from
// there as before: that is the frame, or the cameras. A rod near its root stays.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

// Every row of a record is asked, so noise gets thousands of chances. And cameras that shake by
// less are part of the noise.
constexpr double visible = 15.0;       // times the noise
constexpr double least_step = 3.0e-3;  // m
// A turn of the frame moves markers by different ways. This check is about a push, which a small
// turn goes along with.
constexpr double alike = 0.15;     // of the step, by which the markers' steps may differ
constexpr double before = 0.3;     // of the step: how far anything goes between other samples
constexpr double near_root = 0.5;  // of the way to the farthest marker
constexpr int least_markers = 3;
constexpr double even = 1.2;  // of the clock's steps

Vec3 way(const Samples& samples, int row, int m) {
  return (samples.value.block<1, 3>(row, 3 * m) - samples.value.block<1, 3>(row - 1, 3 * m))
      .transpose();
}

/// What the markers that were seen do between two samples beyond what they did before.
struct Step {
  std::vector<Vec3> of_markers;
  double nearest = 0.0, farthest = 0.0;  ///< m from the root, of those markers
  bool goes_on_as_before = true;

  Vec3 mean() const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& x : of_markers) sum += x / static_cast<double>(of_markers.size());
    return sum;
  }
};

Step step_at(const TrialView& view, int row) {
  const Samples& samples = view.trial.markers;
  Step step;
  step.nearest = view.nominal_plant->reach();
  std::vector<int> seen;
  for (int m = 0; m < static_cast<int>(view.experiment.markers.size()); ++m) {
    // Seen in all four rows, or what it did before is not known.
    if (!samples.value.block(row - 2, 3 * m, 4, 3).allFinite()) continue;
    seen.push_back(m);
    // Beyond the step before, because the plant may be moving all along.
    step.of_markers.push_back(way(samples, row, m) - way(samples, row - 1, m));
    const double from_root = view.nominal_plant->markers()[m].from_root;
    step.nearest = std::min(step.nearest, from_root);
    step.farthest = std::max(step.farthest, from_root);
  }
  if (seen.empty()) return step;
  // The mean and not the largest: of a marker that jumps alone little is left in it.
  const double size = step.mean().norm();
  for (const int m : seen)
    step.goes_on_as_before = step.goes_on_as_before &&
                             way(samples, row - 1, m).norm() < before * size &&
                             // On both sides. Where a plant is let go it moves on after the first
                             // sample, and what was pushed does not.
                             way(samples, row + 1, m).norm() < before * size;
  return step;
}

}  // namespace

std::optional<Fault> check_frame_steps(const TrialView& view) {
  // A base that is moved carries all markers along, as it should.
  if (!view.nominal_plant || view.trial.base) return std::nullopt;
  const Samples& samples = view.trial.markers;
  const double noise = noise_of_markers(view);
  const double usual = clock_of({}, samples.time).step;
  for (int row = 2; row + 1 < samples.size(); ++row) {
    // After a gap anything may have happened in between.
    if (samples.time[row] - samples.time[row - 1] > even * usual) continue;
    const Step step = step_at(view, row);
    // Two that go aside alike may be on one leaf.
    if (static_cast<int>(step.of_markers.size()) < least_markers) continue;
    // Markers that are all far out go aside together whenever the stem does. Only one near the
    // clamp says that it cannot have been the plant.
    if (step.nearest > near_root * step.farthest || !step.goes_on_as_before) continue;
    const Vec3 mean = step.mean();
    if (mean.norm() < std::max(least_step, visible * noise)) continue;
    // Differences of two steps scatter by 2.4 noises an axis (the root of 6), so six noises are 2.4
    // of their deviations.
    const double most = std::max(alike * mean.norm(), 6.0 * noise);
    if (std::ranges::any_of(step.of_markers,
                            [&](const Vec3& x) { return (x - mean).norm() > most; }))
      continue;
    return Fault{"markers.csv",
                 text("has all markers go aside by the same %.3g mm between ", 1e3 * mean.norm()) +
                     text("%.4g and %.4g s", samples.time[row - 1], samples.time[row]) +
                     ": expected those near the root to stay; cameras that were pushed, or a frame "
                     "that was set anew?"};
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
