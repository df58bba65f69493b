// Labels. Two markers that exchange their names do so from one sample to the next, and far from
// their usual steps; short exchanges are put back, one that stays is another record from there on.
// Rods do not stretch: no marker is farther from another than the way along the plant.
#include <algorithm>
#include <cmath>
#include <map>

#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/data/labels.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

constexpr double apart = 1.0e-3;  // m: closer markers are one
constexpr int least_equal = 5;    // rows in which two markers have the same numbers
constexpr double often = 0.2;     // of the rows: less are outliers
// Exchanged labels bring both markers this much nearer to where the drawing has them.
constexpr double nearer = 0.25;
constexpr double little = 0.01;  // m, beside what is known to be possible

using Names = std::vector<Marker>;

std::string both(const Names& names, int a, int b) {
  return names[a].name + " and " + names[b].name;
}

Vec3 place(const Samples& samples, int row, int m) {
  return samples.value.block<1, 3>(row, 3 * m).transpose();
}

// Two markers that are told by one column would agree with any model of one of them.
std::optional<Fault> same_columns(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  const int markers = static_cast<int>(view.experiment.markers.size());
  for (int a = 0; a < markers; ++a)
    for (int b = a + 1; b < markers; ++b) {
      const Spot &one = view.nominal_plant->markers()[a], &other = view.nominal_plant->markers()[b];
      // Two names for one place are no mistake.
      if ((one.drawn - other.drawn).norm() < apart) continue;
      int equal = 0;
      for (int row = 0; row < samples.size(); ++row)
        // To the last digit: noise of two markers never is the same.
        equal += place(samples, row, a) == place(samples, row, b) ? 1 : 0;
      // A tracker that takes one marker for two does so for a while; that is a matter of outliers.
      if (equal < least_equal || equal < often * samples.size()) continue;
      return Fault{"markers.csv", "has the same numbers for " +
                                      both(view.experiment.markers, a, b) + " in " +
                                      std::to_string(equal) +
                                      " rows: expected each marker's own; a column copied?"};
    }
  return std::nullopt;
}

std::optional<Fault> never_seen(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  // A trial without markers may have forces.
  if (samples.size() == 0 || samples.value.array().isFinite().any()) return std::nullopt;
  return Fault{"markers.csv", "has no marker in any of its " + std::to_string(samples.size()) +
                                  " rows: expected where they were; an export that failed?"};
}

std::string number(double x) {
  return text("%.6g", x);
}

// No place is exactly 0, 0, 0, or has one number three times where the plant cannot be: that is how
// some trackers say that they did not see a marker.
std::optional<Fault> words_for_not_seen(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  // Twice the reach: the frame may be turned and scaled.
  const double farthest = 2.0 * view.nominal_plant->reach() + view.nominal_plant->root().norm();
  for (int m = 0; m < static_cast<int>(view.experiment.markers.size()); ++m) {
    // Near the origin of the world a marker may well come by, and numbers cut short may say 0, 0, 0
    // there.
    const bool zero_is_no_place =
        view.nominal_plant->markers()[m].drawn.norm() >= largest_known::offset;
    std::map<double, int> rows;
    for (int row = 0; row < samples.size(); ++row) {
      const Vec3 x = place(samples, row, m);
      // One number three times is how such codes are written, whatever the number: -9999, or 1e6.
      if (x.x() == x.y() && x.y() == x.z()) ++rows[x.x()];
    }
    for (const auto& [said, count] : rows) {
      // Zero is a code by itself. Another number may stand in one row by a fault of that row, so it
      // must come twice.
      const bool impossible =
          said == 0.0 ? zero_is_no_place : count >= 2 && std::abs(said) > farthest;
      if (impossible)
        return Fault{"markers.csv", "has " + view.experiment.markers[m].name + " at exactly " +
                                        number(said) + ", " + number(said) + ", " + number(said) +
                                        " in " + std::to_string(count) +
                                        " rows: expected empty cells where a marker was not seen"};
    }
  }
  return std::nullopt;
}

std::optional<Fault> exchanged_for_good(const TrialView& view) {
  // Up to the end nothing tells which of the two labels was right before, so nothing can be put
  // back.
  for (const LabelExchange& exchange : exchanges_in(view.trial.markers.value)) {
    // Short ones are put back, and told as a remark.
    if (exchange.to < view.trial.markers.size()) continue;
    return Fault{"markers.csv",
                 "has " + both(view.experiment.markers, exchange.a, exchange.b) +
                     text(" exchange their places from %.4g s on: expected one label for one "
                          "marker; labels swapped by the tracker?",
                          view.trial.markers.time[exchange.from])};
  }
  return std::nullopt;
}

// Rows in which two markers are each where the drawing has the other. A frame that is turned about
// the world's origin moves both; it does not exchange them.
std::optional<Fault> exchanged_from_the_start(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  const std::vector<Spot>& spots = view.nominal_plant->markers();
  const FirstPlaces first = first_places(view);
  for (int i = 0; i < first.size(); ++i)
    for (int j = i + 1; j < first.size(); ++j) {
      // By what was seen first, since only those have places to be exchanged.
      const int a = first.marker[i], b = first.marker[j];
      // Neighbours closer than that look exchanged in any strong bend.
      if ((first.settled[i] - first.settled[j]).norm() < 4.0 * little) continue;
      int exchanged = 0, seen = 0;
      for (int row = 0; row < samples.size(); ++row) {
        const Vec3 x = place(samples, row, a), y = place(samples, row, b);
        // Only where both were seen.
        if (!(x + y).allFinite()) continue;
        ++seen;
        // Both together: an exchange brings both home. One alone may pass the other's place in any
        // swing.
        const double kept = (x - first.settled[i]).norm() + (y - first.settled[j]).norm();
        const double other = (x - first.settled[j]).norm() + (y - first.settled[i]).norm();
        // A quarter of the distance, since in a strong bend markers come nearer to the places of
        // others by themselves.
        exchanged += other < nearer * kept ? 1 : 0;
      }
      if (exchanged < least_equal || exchanged < often * seen) continue;
      return Fault{"markers.csv",
                   "has " + both(view.experiment.markers, a, b) +
                       " each where the plant has the other in " + std::to_string(exchanged) +
                       " of " + std::to_string(seen) + " rows: expected " +
                       view.experiment.markers[a].name +
                       text(" at %.3g m from the root along the plant and ", spots[a].from_root) +
                       view.experiment.markers[b].name +
                       text(" at %.3g m; labels exchanged?", spots[b].from_root)};
    }
  return std::nullopt;
}

/// Two markers that are farther apart than the plant is long between them.
struct Stretch {
  int a = 0, b = 0;
  double apart = 0.0, way = 0.0;  // m
  int rows = 0;
};

std::vector<Stretch> stretches(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  const std::vector<Spot>& spots = view.nominal_plant->markers();
  std::vector<Stretch> found;
  for (int a = 0; a < static_cast<int>(spots.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(spots.size()); ++b) {
      // The way along the plant is what no bend makes longer. Through the air they may come as near
      // as they like, so there is no lower bound.
      Stretch stretch{a, b, 0.0, view.nominal_plant->along(spots[a], spots[b]), 0};
      const double most =
          // What a scaled frame and displaced markers may make of it.
          (1.0 + largest_known::scale) * stretch.way + largest_known::offset + little;
      int seen = 0;
      for (int row = 0; row < samples.size(); ++row) {
        const double distance = (place(samples, row, a) - place(samples, row, b)).norm();
        seen += std::isfinite(distance) ? 1 : 0;
        // Written so that a marker that was not seen, whose distance is no number, is passed over.
        if (!(distance > most)) continue;
        stretch.apart = std::max(stretch.apart, distance);
        ++stretch.rows;
      }
      // In many rows: a few are outliers.
      if (stretch.rows >= least_equal && stretch.rows >= often * seen) found.push_back(stretch);
    }
  return found;
}

std::optional<Fault> stretched(const TrialView& view) {
  // All pairs are looked at before any is told, because the first that is found may be the right
  // one of the two.
  const std::vector<Stretch> all = stretches(view);
  if (all.empty()) return std::nullopt;
  // The marker that most of them have in common.
  std::vector<int> count(view.experiment.markers.size(), 0);
  for (const Stretch& one : all) {
    ++count[one.a];
    ++count[one.b];
  }
  // A marker in a wrong place is too far from many others, while those among each other are right.
  const int worst = static_cast<int>(std::ranges::max_element(count) - count.begin());
  const auto with = std::ranges::find_if(
      all, [&](const Stretch& one) { return one.a == worst || one.b == worst; });
  const Marker& marker = view.experiment.markers[worst];
  return Fault{
      "markers.csv",
      "has " + both(view.experiment.markers, with->a, with->b) +
          text(" up to %.3g m apart where the plant is %.3g m long between them: expected ",
               with->apart, with->way) +
          marker.name + text(" at %.3g of ", marker.place.at) + marker.place.curve +
          "; a ghost, another label, unit or place?"};
}

}  // namespace

std::optional<Fault> check_labels(const TrialView& view) {
  // Without any place the others have nothing to ask.
  if (auto fault = never_seen(view)) return fault;
  if (!view.nominal_plant) return std::nullopt;
  // Codes for "not seen" first: a marker at 0, 0, 0 is also stretched, and sometimes two columns
  // are equal by them.
  for (const auto check :
       {words_for_not_seen, same_columns, exchanged_for_good, exchanged_from_the_start, stretched})
    if (auto fault = check(view)) return fault;
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
