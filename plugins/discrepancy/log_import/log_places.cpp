#include <algorithm>

#include "plugins/discrepancy/log_import/log_tables.h"

namespace pedicel::discrepancy {

namespace {

/// "expected one of: a, b, c"
template <class Items>
std::string expected_one_of(const Items& items) {
  constexpr std::size_t most = 12;
  std::string all;
  std::size_t count = 0;
  for (const auto& item : items) {
    if (++count > most) break;
    all += (count > 1 ? ", " : "") + item.name;
  }
  if (items.empty()) all = "(there is none)";
  return ", expected one of: " + all + (count > most ? ", ..." : "");
}

template <class Items>
bool has(const Items& items, const std::string& name) {
  return std::ranges::any_of(items, [&](const auto& item) { return item.name == name; });
}

class Places {
 public:
  Places(const LogScene& scene, Diagnostics& diagnostics)
      : scene_(scene), diagnostics_(diagnostics) {}

  void link(const std::string& name, const SourcePosition& where) {
    if (!has(scene_.robot.links, name))
      diagnostics_.error(where, "link " + in_quotes(name) + " is no link of the robot" +
                                    expected_one_of(scene_.robot.links));
  }

  void marker(const LogMap::Marker& marker) {
    if (!marker.link.empty()) return link(marker.link, marker.where);
    const plant::PlantFile* plant = plant_of(marker);
    if (!plant) return;
    const std::string of = " of the plant " + in_quotes(plant->name);
    if (!marker.fruit.empty() && !has(plant->fruits, marker.fruit))
      diagnostics_.error(marker.where, "fruit " + in_quotes(marker.fruit) + " is no fruit" + of +
                                           expected_one_of(plant->fruits));
    if (!marker.curve.empty() && !has(plant->curves, marker.curve))
      diagnostics_.error(marker.where, "curve " + in_quotes(marker.curve) + " is no curve" + of +
                                           expected_one_of(plant->curves));
  }

 private:
  const plant::PlantFile* plant_of(const LogMap::Marker& marker) {
    if (marker.plant.empty() && scene_.plants.size() == 1) return &scene_.plants.front();
    const auto found = std::ranges::find(scene_.plants, marker.plant, &plant::PlantFile::name);
    if (found != scene_.plants.end()) return &*found;
    diagnostics_.error(marker.where, (marker.plant.empty() ? std::string("a marker names no plant")
                                                           : "plant " + in_quotes(marker.plant) +
                                                                 " is no plant of the scene") +
                                         expected_one_of(scene_.plants));
    return nullptr;
  }

  const LogScene& scene_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_places(const LogMap& map, const LogScene& scene, Diagnostics& diagnostics) {
  Places places(scene, diagnostics);
  for (const LogMap::Marker& marker : map.markers) places.marker(marker);
  for (const LogMap::Wrench& wrench : map.wrenches) places.link(wrench.link, wrench.where);
}

}  // namespace pedicel::discrepancy
