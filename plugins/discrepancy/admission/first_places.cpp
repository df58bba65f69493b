#include "plugins/discrepancy/admission/first_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t looks = 5;  // samples whose median a single outlier does not move

// Axis by axis the median of the first samples that were seen; NaN where there is none. What begins
// in motion goes to and fro about where it would rest: of all its samples.
Vec3 first_seen(const Trial& trial, int m) {
  const Samples& markers = trial.markers;
  std::vector<double> axis[3];
  // Rows in which it was seen, and not the first five of the table: a marker may come into view
  // later.
  for (int row = 0; row < markers.size() && (axis[0].size() < looks || trial.window); ++row) {
    const Vec3 x = markers.value.block<1, 3>(row, 3 * m).transpose();
    if (x.allFinite())
      for (int c = 0; c < 3; ++c) axis[c].push_back(x[c]);
  }
  return {median_of(axis[0]), median_of(axis[1]), median_of(axis[2])};
}

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  // The upper one of two middle values: for what it is used for, half a spacing decides nothing.
  std::ranges::nth_element(values, middle);
  return *middle;
}

double rms_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, a.size())));
}

double FirstPlaces::spread() const {
  // From the root, not from their mean: markers that sit close together far out would seem to have
  // no size.
  return rms_distance(drawn, std::vector<Vec3>(drawn.size(), root));
}

FirstPlaces first_places(const TrialView& view) {
  FirstPlaces places;
  // A base that is moved carries the plant along from the start.
  Pose base;  // of what stood as drawn
  if (view.trial.base && !view.trial.base->time.empty()) {
    // A base's path is that of the root: its place in the world, and how far it has turned since
    // the plant was drawn.
    base.rotation = view.trial.base->rotation_at(0.0);
    base.position = view.trial.base->position_at(0.0) - base.rotation * view.nominal_plant->root();
  }
  places.root = base * view.nominal_plant->root();
  for (int m = 0; m < static_cast<int>(view.experiment.markers.size()); ++m) {
    const Vec3 seen = first_seen(view.trial, m);
    if (!seen.allFinite()) continue;
    const Spot& spot = view.nominal_plant->markers()[m];
    // Those that were seen at all; the others have no first place.
    places.marker.push_back(m);
    places.seen.push_back(seen);
    places.drawn.push_back(base * spot.drawn);
    // As drawn and as settled, both: a plant may have been drawn as it grew or as it hangs. Checks
    // take what is nearer.
    places.settled.push_back(base * spot.settled);
  }
  return places;
}

}  // namespace pedicel::discrepancy
