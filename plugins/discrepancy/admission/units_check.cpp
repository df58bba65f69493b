// Units. Rods do not stretch: two markers are never farther apart than the way along the plant
// between them. A scale of 1.2 may lie on top, and each marker may sit 0.05 m aside.
#include <array>
#include <cmath>

#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// Of the way along the plant. The median of all pairs, so that a marker or two that sit elsewhere
// do not count. From below by the distance in the drawing: a plant that is bent into a hook brings
// its markers together, but not all of them to a third.
constexpr double most = 1.5, least = 0.33;
constexpr double near = 0.05;  // of the reach: offsets count for too much between closer ones

struct Unit {
  const char* name;
  double in_metre;
};
constexpr std::array units = {Unit{"millimetres", 1e3}, Unit{"centimetres", 1e2},
                              Unit{"inches", 39.37},    Unit{"decimetres", 10.0},
                              Unit{"feet", 3.281},      Unit{"micrometres", 1e6},
                              Unit{"kilometres", 1e-3}};
constexpr double same_unit = 1.25;  // a factor

std::string likely_unit(double ratio) {
  for (const Unit& unit : units)
    // By ratio. Units are a factor of 2.5 apart at least, and a bent plant shortens distances.
    if (std::abs(std::log(ratio / unit.in_metre)) < std::log(same_unit))
      return std::string(", not ") + unit.name;
  return {};
}

// Of two points; from the root where there is but one marker.
struct Ratios {
  std::vector<double> along, drawn;
};

Ratios ratios_of(const FirstPlaces& places, const NominalPlant& nominal_plant) {
  Ratios ratios;
  const double least_way = near * nominal_plant.reach();
  const auto add = [&](double seen, double drawn, double along) {
    // Both: markers on two branches may be drawn next to each other and be far apart along the
    // plant.
    if (along < least_way || drawn < 0.5 * least_way) return;
    ratios.along.push_back(seen / along);
    ratios.drawn.push_back(seen / drawn);
  };
  for (int i = 0; i < places.size(); ++i)
    // Between markers rather than from an origin: a distance knows no frame, so a wrong frame is no
    // excuse and no reason.
    for (int j = 0; j < i; ++j)
      add((places.seen[i] - places.seen[j]).norm(), (places.drawn[i] - places.drawn[j]).norm(),
          nominal_plant.along(nominal_plant.markers()[places.marker[i]],
                              nominal_plant.markers()[places.marker[j]]));
  // From the root only where nothing else is left, since that needs the frame's origin to be right,
  // which is asked later.
  if (ratios.along.empty())
    for (int i = 0; i < places.size(); ++i)
      add((places.seen[i] - places.root).norm(), (places.drawn[i] - places.root).norm(),
          nominal_plant.markers()[places.marker[i]].from_root);
  return ratios;
}

}  // namespace

std::optional<Fault> check_units(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  const FirstPlaces places = first_places(view);
  const Ratios ratios = ratios_of(places, *view.nominal_plant);
  if (ratios.along.empty()) return std::nullopt;
  // Of all pairs at once: a unit is wrong for all of them alike.
  const double along = median_of(ratios.along), drawn = median_of(ratios.drawn);
  // From above by the way along the plant, which nothing exceeds. From below by the drawing,
  // because markers of a bent plant are always nearer than that way.
  if (along <= most && drawn >= least) return std::nullopt;
  return Fault{
      "markers.csv",
      (places.size() > 1 ? "has the markers" + text(" %.4g times as far apart", drawn)
                         : "has the marker" + text(" %.4g times as far from the root", drawn)) +
          " as the plant has them: expected metres in the plant's own frame" + likely_unit(drawn)};
}

}  // namespace pedicel::discrepancy
