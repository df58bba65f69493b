#include "plugins/plant/plant_edit.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/csv.h"
#include "plugins/plant/plant_edit_parts.h"
#include "plugins/plant/plant_graph.h"
#include "plugins/plant/point_kind.h"

namespace pedicel::plant {

namespace {

template <typename Item>
bool has(const std::vector<Item>& items, const std::string& name) {
  return std::any_of(items.begin(), items.end(),
                     [&](const Item& item) { return item.name == name; });
}

bool is_taken(const PlantFile& plant, const std::string& name) {
  return has(plant.curves, name) || has(plant.fruits, name) || has(plant.leaves, name);
}

void check_curve(const PlantCurve& curve) {
  if (curve.points.size() < 2)
    throw UsageError(curve.name + " has " + std::to_string(curve.points.size()) +
                     " points, expected at least 2");
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (!curve.points[i].allFinite())
      throw UsageError(curve.name + ": point " + std::to_string(i) + " is no place");
    if (i > 0 && (curve.points[i] - curve.points[i - 1]).norm() < smallest_gap)
      throw UsageError(curve.name + ": points " + std::to_string(i - 1) + " and " +
                       std::to_string(i) + " are at one place, expected them apart");
  }
  if (curve.radius.size() > 1 && curve.radius.size() != curve.points.size())
    throw UsageError(curve.name + " has " + std::to_string(curve.radius.size()) + " radii for " +
                     std::to_string(curve.points.size()) +
                     " points, expected one number or one a point");
  for (const double radius : curve.radius)
    if (!(radius > 0.0) || !std::isfinite(radius))
      throw UsageError(curve.name + ": radius " + io::format_number(radius) +
                       " m, expected one above 0");
}

/// One radius a point, however many there were.
void spread_radius(PlantCurve& curve) {
  if (curve.radius.size() == 1) curve.radius.assign(curve.points.size(), curve.radius.front());
}

template <typename Items>
void drop_on(Items& items, const std::string& curve) {
  std::erase_if(items, [&](const auto& item) { return item.place.curve == curve; });
}

void rename_curve(PlantFile& plant, const std::string& name, const std::string& new_name) {
  const auto take = [&](CurvePlace& place) {
    if (place.curve == name) place.curve = new_name;
  };
  for (CurvePlace& support : plant.supports) take(support);
  for (PlantFruit& fruit : plant.fruits) take(fruit.place);
  for (PlantLeaf& leaf : plant.leaves) take(leaf.place);
  for (PlantMass& mass : plant.masses) take(mass.place);
  for (Effect& effect : plant.effects)
    if (effect.place) take(*effect.place);
}

}  // namespace

int find_stem(const PlantFile& plant, const std::string& name) {
  const int index = plant.curve_index(name);
  if (index >= 0) return index;
  const std::string names = joined(plant.curves, &PlantCurve::name);
  throw UsageError("no stem \"" + name + "\", expected " +
                   (names.empty() ? "one that was drawn before" : "one of: " + names));
}

geometry::Curve stem_curve(const PlantFile& plant, const std::string& name) {
  PlantFile one;
  one.curves = {plant.curves[find_stem(plant, name)]};
  return make_curves(one).front();
}

std::string free_name(const PlantFile& plant, const std::string& wanted) {
  std::string name = wanted;
  for (int i = 2; is_taken(plant, name); ++i) name = wanted + "_" + std::to_string(i);
  return name;
}

void drop_curve(PlantFile& plant, const std::string& name) {
  drop_on(plant.fruits, name);
  drop_on(plant.leaves, name);
  drop_on(plant.masses, name);
  std::erase_if(plant.supports, [&](const CurvePlace& place) { return place.curve == name; });
  std::erase_if(plant.effects,
                [&](const Effect& effect) { return effect.place && effect.place->curve == name; });
  std::erase_if(plant.curves, [&](const PlantCurve& curve) { return curve.name == name; });
}

void check_point(const PlantCurve& curve, int point) {
  const int count = static_cast<int>(curve.points.size());
  if (point < 0 || point >= count)
    throw UsageError("point " + std::to_string(point) + " of " + curve.name +
                     ": expected one from 0 to " + std::to_string(count - 1));
}

void check_free(const PlantFile& plant, const std::string& name) {
  if (name.empty()) throw UsageError("an empty name, expected one");
  if (is_taken(plant, name))
    throw UsageError("\"" + name + "\" is there already, expected a new name");
}

void replace_curve(PlantFile& plant, int index, PlantCurve curve) {
  check_curve(curve);
  const BranchesFollow follow(plant, index);
  plant.curves[index] = std::move(curve);
  follow.move(plant);
}

void add_stem(PlantFile& plant, PlantCurve curve) {
  check_free(plant, curve.name);
  check_curve(curve);
  if (curve.radius.empty() && curve.section.kind != SectionKind::rectangle)
    throw UsageError(curve.name + " has no radius, expected one");
  plant.curves.push_back(std::move(curve));
}

void remove_stem(PlantFile& plant, const std::string& name, bool with_branches) {
  const int index = find_stem(plant, name);
  std::vector<std::string> going = {name};
  if (with_branches)
    for (const int branch : branches_of(stem_tree(plant), index))
      going.push_back(plant.curves[branch].name);
  for (const std::string& one : going) drop_curve(plant, one);
}

void rename(PlantFile& plant, const std::string& name, const std::string& new_name) {
  if (!is_taken(plant, name))
    throw UsageError("no stem, fruit or leaf \"" + name + "\", expected one of this plant");
  check_free(plant, new_name);
  if (plant.curve_index(name) >= 0) rename_curve(plant, name, new_name);
  const auto take = [&](auto& items) {
    for (auto& item : items)
      if (item.name == name) item.name = new_name;
  };
  take(plant.curves);
  take(plant.fruits);
  take(plant.leaves);
}

void move_point(PlantFile& plant, const std::string& stem, int point, const Vec3& to) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  check_point(curve, point);
  move_control_point(curve, point, to);
  replace_curve(plant, index, std::move(curve));
}

int insert_point(PlantFile& plant, const std::string& stem, double at) {
  const int index = find_stem(plant, stem);
  check_fraction(at);
  const geometry::Curve drawn = stem_curve(plant, stem);
  PlantCurve curve = plant.curves[index];
  const double arc = at * drawn.length();
  int before = 1;
  while (before + 1 < drawn.control_points() && drawn.control_arc(before) < arc) ++before;
  curve.points.insert(curve.points.begin() + before, drawn.point(arc));
  if (curve.radius.size() > 1)
    curve.radius.insert(curve.radius.begin() + before, drawn.radius(arc));
  replace_curve(plant, index, std::move(curve));
  return before;
}

void remove_point(PlantFile& plant, const std::string& stem, int point) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  check_point(curve, point);
  remove_control_point(curve, point);
  if (curve.radius.size() > 1 && curve.points.size() < 2) curve.radius.resize(1);
  replace_curve(plant, index, std::move(curve));
}

void set_points(PlantFile& plant, const std::string& stem, const std::vector<Vec3>& points) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  if (curve.radius.size() > 1 && points.size() != curve.points.size()) {
    const geometry::Curve drawn = stem_curve(plant, stem);
    std::vector<double> radius;
    for (std::size_t i = 0; i < points.size(); ++i)
      radius.push_back(drawn.radius(drawn.length() * static_cast<double>(i) /
                                    std::max(1.0, static_cast<double>(points.size()) - 1.0)));
    curve.radius = std::move(radius);
  }
  curve.points = points;
  replace_curve(plant, index, std::move(curve));
}

void smooth_points(PlantFile& plant, const std::string& stem, double share, int first, int last) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  check_point(curve, first);
  check_point(curve, last);
  if (!(share > 0.0 && share <= 1.0))
    throw UsageError("a share of " + io::format_number(share) + ", expected one above 0, up to 1");
  const std::vector<Vec3> points = curve.points;
  const int end = std::min(last, static_cast<int>(points.size()) - 2);
  for (int i = std::max(first, 1); i <= end; ++i)
    curve.points[i] += share * (0.5 * (points[i - 1] + points[i + 1]) - points[i]);
  replace_curve(plant, index, std::move(curve));
}

void move_stem(PlantFile& plant, const std::string& stem, const Vec3& by) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  for (Vec3& point : curve.points) point += by;
  replace_curve(plant, index, std::move(curve));
}

void set_length(PlantFile& plant, const std::string& stem, double length) {
  const int index = find_stem(plant, stem);
  if (!(length > 0.0) || !std::isfinite(length))
    throw UsageError("a length of " + io::format_number(length) + " m, expected one above 0");
  PlantCurve curve = plant.curves[index];
  const StemJoint joint = stem_tree(plant)[index];
  const Vec3 foot = joint.foot_first ? curve.points.front() : curve.points.back();
  const double factor = length / stem_curve(plant, stem).length();
  for (Vec3& point : curve.points) point = foot + factor * (point - foot);
  replace_curve(plant, index, std::move(curve));
}

void set_radius(PlantFile& plant, const std::string& stem, int point, double radius) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  if (point < 0) {
    curve.radius = {radius};
  } else {
    check_point(curve, point);
    if (curve.radius.empty()) throw UsageError(stem + " has no radius of its own to change");
    spread_radius(curve);
    curve.radius[point] = radius;
    for (const int beside : {point - 1, point + 1})  // those that hold a corner have its radius
      if (beside >= 0 && beside < static_cast<int>(curve.points.size()) &&
          held_point(curve, beside) == point)
        curve.radius[beside] = radius;
  }
  replace_curve(plant, index, std::move(curve));
}

void taper(PlantFile& plant, const std::string& stem, double from, double to) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  const geometry::Curve drawn = stem_curve(plant, stem);
  const bool foot_first = stem_tree(plant)[index].foot_first;
  curve.radius.clear();
  for (int i = 0; i < drawn.control_points(); ++i) {
    const double share = drawn.control_arc(i) / drawn.length();
    curve.radius.push_back(from + (foot_first ? share : 1.0 - share) * (to - from));
  }
  replace_curve(plant, index, std::move(curve));
}

void set_interpolation(PlantFile& plant, const std::string& stem, Interpolation interpolation) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  curve.interpolation = interpolation;
  replace_curve(plant, index, std::move(curve));
}

}  // namespace pedicel::plant
