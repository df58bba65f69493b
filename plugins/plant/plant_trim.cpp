#include <cmath>

#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/plant_edit_parts.h"

namespace pedicel::plant {

namespace {

constexpr double least = 1.0e-3;  // m, that a cut leaves and takes

/// What stays of a stem: from its first point to the cut, or from the cut on.
struct Cut {
  double arc = 0.0, length = 0.0;  // m
  bool foot_first = true;

  double at() const { return arc / length; }
  bool is_beyond(double place) const { return foot_first ? place > at() : place < at(); }
  /// A place of the old stem on the new one.
  double moved(double place) const {
    const double far = foot_first ? place / at() : (place - at()) / (1.0 - at());
    return std::min(1.0, std::max(0.0, far));
  }
};

PlantCurve shortened(const PlantCurve& curve, const geometry::Curve& drawn, const Cut& cut) {
  PlantCurve rest = curve;
  rest.points.clear();
  const bool varies = curve.radius.size() > 1;
  if (varies) rest.radius.clear();
  const auto put = [&](const Vec3& point, double radius) {
    rest.points.push_back(point);
    if (varies) rest.radius.push_back(radius);
  };
  const auto put_end = [&] { put(drawn.point(cut.arc), drawn.radius(cut.arc)); };
  if (!cut.foot_first) put_end();
  for (int i = 0; i < drawn.control_points(); ++i) {
    const double arc = drawn.control_arc(i);
    // A control point at the cut itself gives way to the new end.
    const bool stays = cut.foot_first ? arc < cut.arc - smallest_gap : arc > cut.arc + smallest_gap;
    if (stays) put(curve.points[i], varies ? curve.radius[i] : 0.0);
  }
  if (cut.foot_first) put_end();
  return rest;
}

template <typename Items, typename PlaceOf>
void trim_items(Items& items, const std::string& stem, const Cut& cut, const PlaceOf& place_of) {
  std::erase_if(items, [&](auto& item) {
    const CurvePlace* place = place_of(item);
    return place && place->curve == stem && cut.is_beyond(place->at);
  });
  for (auto& item : items)
    if (CurvePlace* place = place_of(item); place && place->curve == stem)
      place->at = cut.moved(place->at);
}

void trim_organs(PlantFile& plant, const std::string& stem, const Cut& cut) {
  const auto own = [](auto& item) { return &item.place; };
  trim_items(plant.fruits, stem, cut, own);
  trim_items(plant.leaves, stem, cut, own);
  trim_items(plant.masses, stem, cut, own);
  trim_items(plant.supports, stem, cut, [](CurvePlace& place) { return &place; });
  trim_items(plant.effects, stem, cut,
             [](Effect& effect) { return effect.place ? &*effect.place : nullptr; });
}

std::vector<std::string> branches_beyond(const PlantFile& plant, int stem, const Cut& cut) {
  const std::vector<StemJoint> tree = stem_tree(plant);
  std::vector<std::string> going;
  for (std::size_t c = 0; c < tree.size(); ++c) {
    if (!tree[c].joined || tree[c].parent != stem || !cut.is_beyond(tree[c].parent_at)) continue;
    going.push_back(plant.curves[c].name);
    for (const int branch : branches_of(tree, static_cast<int>(c)))
      going.push_back(plant.curves[branch].name);
  }
  return going;
}

}  // namespace

void trim_stem(PlantFile& plant, const std::string& stem, double at) {
  const int index = find_stem(plant, stem);
  check_fraction(at);
  const geometry::Curve drawn = stem_curve(plant, stem);
  const Cut cut{at * drawn.length(), drawn.length(), stem_tree(plant)[index].foot_first};
  const double left = cut.foot_first ? cut.arc : cut.length - cut.arc;
  if (left < least)
    throw UsageError("a cut of " + stem + " at " + io::format_number(at, 4) +
                     " leaves less than 1 mm of it, expected one farther from its foot (or: delete "
                     "stem)");
  if (cut.length - left < least)
    throw UsageError("a cut of " + stem + " at " + io::format_number(at, 4) +
                     " is less than 1 mm from its tip, expected one nearer to its foot");
  PlantCurve rest = shortened(plant.curves[index], drawn, cut);
  for (const std::string& branch : branches_beyond(plant, index, cut)) drop_curve(plant, branch);
  trim_organs(plant, stem, cut);
  plant.curves[plant.curve_index(stem)] = std::move(rest);
}

}  // namespace pedicel::plant
