// Slips. One marker goes aside from one sample to the next, and on from there as before, while all
// others do what they did: it was touched, or it slid along its stem. A rod moves as a whole, and
// no effect moves one marker for once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_clock.h"
#include "plugins/discrepancy/simulate/trial_run.h"

namespace pedicel::discrepancy {

namespace {

// Every row of every marker is asked, so noise must never reach it.
constexpr double visible = 15.0;       // times the noise
constexpr double least_step = 5.0e-3;  // m
constexpr double smooth = 0.3;         // of the step, by which other steps may differ in a row
// Of the step, by which others may change theirs. What pulls a stem aside at its tip moves half of
// it by 0.3 of that.
constexpr double others_share = 0.1;
constexpr double near = 0.5;  // of the way from the root: a marker must be so near to see that
// A step over a gap is the sum of several, and says nothing of how fast they were.
constexpr double even = 1.2;   // of the clock's steps
constexpr int around = 12;     // samples on either side that the step must outlast
constexpr double lasts = 0.5;  // of the step stays at least
// s, beside a load or a release: a latency, and what a light tip then does.
constexpr double before_jump = 0.1, after_jump = largest_known::latency + 0.1;

Vec3 place(const Samples& samples, int row, int m) {
  return samples.value.block<1, 3>(row, 3 * m).transpose();
}
Vec3 way(const Samples& samples, int row, int m) {
  return place(samples, row, m) - place(samples, row - 1, m);
}
bool is_seen(const Samples& samples, int row, int m) {
  return samples.value.block(row - 3, 3 * m, 6, 3).allFinite();
}

// Beyond what it does before and after.
Vec3 step_of(const Samples& samples, int row, int m) {
  // So a marker that is moving all along has none.
  return way(samples, row, m) - 0.5 * (way(samples, row - 1, m) + way(samples, row + 1, m));
}

bool is_smooth_beside(const Samples& samples, int row, int m, double most) {
  // Steps but the one in question must be alike. A marker that jumps about is a matter of outliers.
  const auto differ = [&](int a, int b) {
    return (way(samples, row + a, m) - way(samples, row + b, m)).norm();
  };
  // Three differences, which leave out the step itself.
  return differ(-2, -1) < most && differ(-1, 1) < most && differ(1, 2) < most;
}

class Slips {
 public:
  explicit Slips(const TrialView& view)
      : view_(view),
        samples_(view.trial.markers),
        noise_(noise_of_markers(view)),
        // Of the table's own clock: what counts as a gap depends on how often is sampled.
        usual_(clock_of({}, samples_.time).step),
        // The times at which a force jumps, as the simulator steps by them.
        jumps_(jumps_of(view.trial, view.trial.effects)) {}

  std::optional<Fault> of(int m) const {
    std::vector<int> rows;
    // Three rows before and two behind: what it does on either side has to be known.
    for (int row = 3; row + 2 < samples_.size(); ++row)
      if (is_slip(row, m)) rows.push_back(row);
    // Twice: the tracker took something else for it for a while, and came back. What slipped stays.
    if (rows.size() != 1 || !outlasts(rows[0], m) || came_back(rows[0], m)) return std::nullopt;
    const int row = rows[0];
    return Fault{"markers.csv",
                 "has " + view_.experiment.markers[m].name +
                     text(" go aside by %.3g mm between ", 1e3 * step_of(samples_, row, m).norm()) +
                     text("%.4g and %.4g s", samples_.time[row - 1], samples_.time[row]) +
                     ", while the other markers do not: expected a marker to stay where it is "
                     "fixed; one that slipped, or was put on anew?"};
  }

 private:
  bool is_slip(int row, int m) const {
    if (!is_seen(samples_, row, m) || is_beside_jump(row)) return false;
    // Over a gap nobody knows what happened.
    if (samples_.time[row + 2] - samples_.time[row - 3] > even * 5.0 * usual_) return false;
    // As a step and not as a speed: what slips does so within one interval, however long that is.
    const double step = step_of(samples_, row, m).norm();
    if (step < std::max(least_step, visible * noise_)) return false;
    if (!is_smooth_beside(samples_, row, m, smooth * step + 6.0 * noise_)) return false;
    // Last, since it looks at all markers.
    return others_go_on(row, m, others_share * step + 4.0 * noise_);
  }

  // Where a load changes or a hand opens, a light tip may go as far within a sample, and alone.
  bool is_beside_jump(int row) const {
    return std::ranges::any_of(jumps_, [&](double jump) {
      return samples_.time[row] > jump - before_jump && samples_.time[row - 1] < jump + after_jump;
    });
  }

  // And one of them is so near that it would be taken along.
  bool others_go_on(int row, int m, double most) const {
    const std::vector<Spot>& spots = view_.nominal_plant->markers();
    // Without a neighbour that is near, a stem may have been pulled where only this marker sees it.
    bool any_near = false;
    for (int other = 0; other < static_cast<int>(spots.size()); ++other) {
      // One that was hidden says nothing either way.
      if (other == m || !is_seen(samples_, row, other)) continue;
      if (step_of(samples_, row, other).norm() > most) return false;
      any_near = any_near ||
                 view_.nominal_plant->along(spots[m], spots[other]) < near * spots[m].from_root;
    }
    return any_near;
  }

  // Its mean place is another after it.
  bool outlasts(int row, int m) const {
    const Vec3 step = step_of(samples_, row, m);
    const auto mean = [&](int from, int to) {
      Vec3 sum = Vec3::Zero();
      int count = 0;
      // As many rows as there are, near the ends of a record.
      for (int i = std::max(from, 0); i < std::min(to, samples_.size()); ++i) {
        // Rows in which it was hidden are no part of the mean.
        if (!place(samples_, i, m).allFinite()) continue;
        sum += place(samples_, i, m);
        ++count;
      }
      return Vec3(sum / std::max(count, 1));
    };
    // By means, so that a swing about either place does not hide it.
    const Vec3 change = mean(row, row + around) - mean(row - around, row);
    // Along the step: what it changes across is its swing.
    return change.dot(step) > lasts * step.squaredNorm();
  }

  // While it was not seen it went as far against that step.
  bool came_back(int row, int m) const {
    const Vec3 step = step_of(samples_, row, m);
    const Track track = track_of(view_.trial, m);
    for (std::size_t i = 1; i < track.time.size(); ++i) {
      if (track.time[i] - track.time[i - 1] < even * usual_) continue;
      // Then its name went to something else for a while; the row of the return was hidden by a
      // gap.
      if ((track.place[i] - track.place[i - 1]).dot(step) < -lasts * step.squaredNorm())
        return true;
    }
    return false;
  }

  const TrialView& view_;
  const Samples& samples_;
  double noise_, usual_;
  std::vector<double> jumps_;  // s
};

}  // namespace

std::optional<Fault> check_slips(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  // What comes off takes markers along.
  if (std::ranges::any_of(view.trial.events,
                          [](const MeasuredEvent& event) { return event.is_detachment(); }))
    return std::nullopt;
  const Slips slips(view);
  for (int m = 0; m < static_cast<int>(view.experiment.markers.size()); ++m)
    if (auto fault = slips.of(m)) return fault;
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
