#include "app/session/document/document_bounds.h"

#include <algorithm>

#include "app/session/document/document.h"
#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "plugins/simulation/plants/plant_overrides.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

namespace {

constexpr double most_length = 1.0e3;  // m, of a stem: the tallest trees are 0.12 km
constexpr double most_nodes = 2.5e5;   // of a plant

std::string nodes_text(double nodes) {
  return io::format_number(nodes, 2) + " nodes";
}

/// m. Straight between its points: no shorter than a tenth of the curve, and cheap.
double rough_length(const plant::PlantCurve& curve) {
  double length = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += (curve.points[i] - curve.points[i - 1]).norm();
  return length;
}

void check_plant(const plant::PlantFile& plant) {
  double nodes = 0.0;
  for (const plant::PlantCurve& curve : plant.curves) {
    const double length = rough_length(curve);
    // Written so that a length that is no number is refused, too.
    if (!(length <= most_length))
      throw UsageError("stem \"" + curve.name + "\" would be " + io::format_number(length, 4) +
                       " m long, expected at most " + io::format_number(most_length) + " m");
    const double own = 1.0 + length / plant.distance;
    nodes += own;
    if (!(nodes <= most_nodes))
      throw UsageError("stem \"" + curve.name + "\" would take " + nodes_text(own) + " at " +
                       io::format_number(1e3 * plant.distance, 4) +
                       " mm from node to node, expected at most " + io::format_number(most_nodes) +
                       " nodes in a plant");
  }
}

/// With what the settings make of it.
plant::PlantFile set_plant(const Document& document, const world::Scene& scene, std::size_t p) {
  plant::PlantFile plant = *document.plants[p].file;
  Diagnostics ignored;  // they were checked when they were set
  simulation::apply_plant_overrides(plant, scene.plants[p].set, ignored);
  return plant;
}

}  // namespace

void check_bounds(const Document& before, const Document& after) {
  const bool set = before.settings != after.settings;
  const world::Scene now = scene_of(after), was = set ? scene_of(before) : world::Scene{};
  for (std::size_t p = 0; p < after.plants.size(); ++p) {
    const DocumentPlant& one = after.plants[p];
    if (!one.file) continue;
    const int index = before.plant_index(one.entry.name);
    const auto old = static_cast<std::size_t>(std::max(index, 0));
    if (index >= 0 && before.plants[old].file == one.file &&
        (!set || set_plant(before, was, old).distance == set_plant(after, now, p).distance))
      continue;
    check_plant(set_plant(after, now, p));
  }
}

}  // namespace pedicel::app
