#include <algorithm>
#include <limits>
#include <set>

#include "engine/io/csv.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::plant {

namespace {

constexpr double same_place = 1.0e-9;  ///< m
/// Sine of the smallest angle between a flat section's normal and its curve.
constexpr double smallest_sine = 1.0e-3;
/// m: beyond it positions have fewer digits than a rod needs. Map coordinates lie within.
constexpr double largest_coordinate = 1.0e7;

std::string quoted(const std::string& kind, const std::string& name) {
  return kind + " \"" + name + "\"";
}

std::string metres(double value) {
  return io::format_number(value, 6) + " m";
}

class Checker {
 public:
  Checker(const PlantFile& plant, Diagnostics& diagnostics)
      : plant_(plant), diagnostics_(diagnostics) {}

  void run() {
    check_names("curve", plant_.curves);
    check_names("fruit", plant_.fruits);
    check_names("leaf", plant_.leaves);
    if (plant_.curves.empty())
      error(plant_.where, "a plant without curves, expected at least one under curves");
    for (const PlantCurve& curve : plant_.curves) check_curve(curve);
    check_places();
    check_materials();
    check_root();
  }

 private:
  void error(const Where& where, std::string what) { diagnostics_.error(where, std::move(what)); }

  template <typename Item>
  void check_names(const std::string& kind, const std::vector<Item>& items) {
    std::set<std::string> seen;
    for (const Item& item : items)
      if (!seen.insert(item.name).second)
        error(item.where, quoted(kind, item.name) + " appears twice, expected each name once");
  }

  void check_curve(const PlantCurve& curve) {
    const std::string name = quoted("curve", curve.name);
    const std::vector<Vec3>& points = curve.points;
    if (points.size() < 2)
      error(curve.where, name + " has " + std::to_string(points.size()) +
                             (points.size() == 1 ? " point" : " points") + ", expected at least 2");
    for (std::size_t i = 1; i < points.size(); ++i)
      if ((points[i] - points[i - 1]).norm() < same_place)
        error(curve.where, name + ": points " + std::to_string(i) + " and " +
                               std::to_string(i + 1) + " are equal, expected them apart");
    check_coordinates(curve, name);
    check_radius(curve, name);
    check_section(curve, name);
  }

  void check_coordinates(const PlantCurve& curve, const std::string& name) {
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      if (const double most = curve.points[i].cwiseAbs().maxCoeff(); !(most <= largest_coordinate))
        error(curve.where, name + ": point " + std::to_string(i + 1) + " is " + metres(most) +
                               " from the origin, expected at most " + metres(largest_coordinate));
  }

  void check_radius(const PlantCurve& curve, const std::string& name) {
    const std::size_t count = curve.radius.size();
    if (count == 0 && curve.section.kind != SectionKind::rectangle)
      error(curve.where, name + " has no radius, expected one (only a rectangle needs none)");
    if (count > 1 && count != curve.points.size())
      error(curve.where, name + " has " + std::to_string(count) + " radii for " +
                             std::to_string(curve.points.size()) +
                             " points, expected one number or one a point");
  }

  void check_section(const PlantCurve& curve, const std::string& name) {
    const SectionShape& section = curve.section;
    if (section.kind == SectionKind::circle) return;
    if (section.kind == SectionKind::rectangle && section.height > section.width)
      error(curve.where, name + ": the height " + metres(section.height) + " is over the width " +
                             metres(section.width) +
                             ", expected the height, along normal, to be the smaller extent");
    const double length = section.normal.norm();
    if (length < same_place) {
      error(curve.where, name + ": its normal has length 0, expected a direction [x, y, z]");
      return;
    }
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const Vec3 piece = curve.points[i] - curve.points[i - 1];
      if (piece.norm() < same_place) continue;
      if (section.normal.cross(piece).norm() >= smallest_sine * length * piece.norm()) continue;
      error(curve.where, name + ": its normal runs along the curve from point " +
                             std::to_string(i) + " to " + std::to_string(i + 1) +
                             ", expected a direction across it");
    }
  }

  void check_place(const std::string& what, const CurvePlace& place, const Where& owner) {
    if (plant_.curve_index(place.curve) >= 0) return;
    constexpr std::size_t shown = 10;
    std::string names;
    for (std::size_t i = 0; i < std::min(shown, plant_.curves.size()); ++i)
      names += (i ? ", " : "") + plant_.curves[i].name;
    if (plant_.curves.size() > shown) names += ", ...";
    error(place.where.line > 0 ? place.where : owner,
          what + " is on " + quoted("curve", place.curve) +
              ", which is unknown, expected one of: " + names);
  }

  void check_places() {
    for (const CurvePlace& support : plant_.supports)
      check_place("a support", support, plant_.where);
    for (const PlantFruit& fruit : plant_.fruits)
      check_place(quoted("fruit", fruit.name), fruit.place, fruit.where);
    for (const PlantLeaf& leaf : plant_.leaves)
      check_place(quoted("leaf", leaf.name), leaf.place, leaf.where);
    for (const PlantMass& mass : plant_.masses) check_place("a mass", mass.place, plant_.where);
    for (const Effect& effect : plant_.effects)
      if (effect.place) check_place(quoted("effect", effect.name), *effect.place, effect.where);
  }

  // One error per value, at the first curve that lacks it: a plant without a material would repeat
  // it for every curve.
  void check_material(const PlantKey<MaterialValues>& key) {
    if (number_of(plant_.material, key)) return;
    for (const PlantCurve& curve : plant_.curves) {
      if (number_of(curve.material, key)) continue;
      error(curve.where, quoted("curve", curve.name) + " has no " + std::string(key.name) +
                             ", expected it in its own material or in the plant's");
      return;
    }
  }

  void check_materials() {
    for (const MaterialKey& key : material_keys)
      if (key.needed) check_material(key);
  }

  void check_root() {
    double nearest = std::numeric_limits<double>::infinity();
    std::string name;
    for (const PlantCurve& curve : plant_.curves) {
      if (curve.points.empty()) continue;
      const double distance = std::min((curve.points.front() - plant_.root).norm(),
                                       (curve.points.back() - plant_.root).norm());
      if (distance >= nearest) continue;
      nearest = distance;
      name = curve.name;
    }
    if (!name.empty() && nearest > plant_.connect)
      error(plant_.where, "the root is " + metres(nearest) + " from the nearest curve end, of " +
                              quoted("curve", name) +
                              ", expected at most connect = " + metres(plant_.connect));
  }

  const PlantFile& plant_;
  Diagnostics& diagnostics_;
};

}  // namespace

bool check_plant(const PlantFile& plant, Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  Checker(plant, diagnostics).run();
  return diagnostics.error_count() == before;
}

}  // namespace pedicel::plant
