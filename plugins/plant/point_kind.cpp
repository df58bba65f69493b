#include "plugins/plant/point_kind.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/plant_edit_parts.h"

namespace pedicel::plant {

namespace {

constexpr double hold = 1.5e-3;      // m, of a holding point from its corner, at most
constexpr double hold_share = 0.1;   // of the way to the neighbour, at most
constexpr double farthest = 2.0e-3;  // m, at which a point is taken for a holding one
constexpr double most_share = 0.45;  // of the piece on its other side
constexpr double straight = 1.0e-3;  // rad

/// A control point with what has to be known to lay the curve again.
struct Main {
  int index = 0;
  Vec3 position = Vec3::Zero();
  double radius = 0.0;  // m
  PointKind kind = PointKind::smooth;
  bool held_before = false, held_behind = false;
};

double gap(const PlantCurve& curve, int from) {
  return (curve.points[from + 1] - curve.points[from]).norm();
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double bend(const PlantCurve& curve, int i) {
  return angle(curve.points[i] - curve.points[i - 1], curve.points[i + 1] - curve.points[i]);
}

bool is_end(const PlantCurve& curve, int i) {
  return i <= 0 || i + 1 >= static_cast<int>(curve.points.size());
}

/// Whether the gaps are those of a point that holds its neighbour at `side` (-1, 1).
bool looks_like_holding(const PlantCurve& curve, int i, int side) {
  if (is_end(curve, i)) return false;
  const double near = gap(curve, side < 0 ? i - 1 : i), far = gap(curve, side < 0 ? i : i - 1);
  return near <= farthest && near <= most_share * far;
}

/// The neighbour that a point holds; -1: none. Of two that look as if they held each other, the
/// straighter one does.
int holds(const PlantCurve& curve, int i) {
  for (const int side : {-1, 1}) {
    if (!looks_like_holding(curve, i, side)) continue;
    const int other = i + side;
    const bool mutual = looks_like_holding(curve, other, -side);
    if (mutual &&
        (bend(curve, other) < bend(curve, i) || (bend(curve, other) == bend(curve, i) && side > 0)))
      continue;
    return other;
  }
  return -1;
}

double radius_at(const PlantCurve& curve, int i) {
  if (curve.radius.empty()) return 0.0;
  return curve.radius.size() == 1 ? curve.radius.front() : curve.radius[i];
}

void give_kind(const PlantCurve& curve, std::vector<Main>& all, std::size_t m) {
  const auto is_straight = [&](std::size_t a) {  // the piece behind it
    const Main &one = all[a], &next = all[a + 1];
    if (!(is_end(curve, one.index) || one.held_behind)) return false;
    if (!(is_end(curve, next.index) || next.held_before)) return false;
    const Vec3 way = next.position - one.position;
    for (int i = one.index + 1; i < next.index; ++i)
      if (angle(curve.points[i] - one.position, way) > straight) return false;
    return true;
  };
  Main& one = all[m];
  const bool inner = m > 0 && m + 1 < all.size();
  const bool before = m == 0 || is_straight(m - 1);
  const bool behind = m + 1 == all.size() || is_straight(m);
  if (inner && !(one.held_before && one.held_behind)) return;
  if (before && behind && all.size() > 2)
    one.kind = PointKind::linear;
  else if (inner)
    one.kind = PointKind::corner;
}

/// Per point the neighbour that it holds, -1: none. A point that stands alone beside another, where
/// no straight piece needs it, is a control point that happens to be near.
std::vector<int> holders(const PlantCurve& curve) {
  const int count = static_cast<int>(curve.points.size());
  std::vector<int> held(curve.points.size(), -1);
  if (curve.interpolation == Interpolation::linear) return held;
  for (int i = 0; i < count; ++i) held[i] = holds(curve, i);
  const auto is_held_on = [&](int i, int side) {
    return i + side >= 0 && i + side < count && held[i + side] == i;
  };
  for (int i = 0; i < count; ++i) {
    const int target = held[i];
    if (target < 0 || is_held_on(target, target - i)) continue;
    const int side = i - target;  // from the point to the one that holds it
    int far = i + side;
    while (far > 0 && far + 1 < count && held[far] >= 0) far += side;
    const bool sharp = is_end(curve, far) || (is_held_on(far, -1) && is_held_on(far, 1));
    const Vec3 way = curve.points[far] - curve.points[target];
    if (!sharp || angle(curve.points[i] - curve.points[target], way) > straight) held[i] = -1;
  }
  return held;
}

std::vector<Main> mains_of(const PlantCurve& curve) {
  std::vector<Main> all;
  const bool linear = curve.interpolation == Interpolation::linear;
  const int count = static_cast<int>(curve.points.size());
  const std::vector<int> held = holders(curve);
  for (int i = 0; i < count; ++i) {
    if (held[i] >= 0) continue;
    Main one{i, curve.points[i], radius_at(curve, i)};
    if (linear) one.kind = PointKind::linear;
    one.held_before = i > 0 && held[i - 1] == i;
    one.held_behind = i + 1 < count && held[i + 1] == i;
    all.push_back(one);
  }
  if (!linear)
    for (std::size_t m = 0; m < all.size(); ++m) give_kind(curve, all, m);
  return all;
}

/// The curve through control points of these kinds.
void lay(PlantCurve& curve, std::vector<Main>& all) {
  const std::size_t count = all.size();
  const bool varies = curve.radius.size() > 1,
             linear = curve.interpolation == Interpolation::linear;
  std::vector<Vec3> points;
  std::vector<double> radius;
  const auto put = [&](const Vec3& point, double r) {
    points.push_back(point), radius.push_back(r);
  };
  const auto held = [&](std::size_t m, std::size_t neighbour) {
    const bool inner = m > 0 && m + 1 < count;
    return !linear && inner &&
           (all[m].kind != PointKind::smooth || all[neighbour].kind == PointKind::linear);
  };
  const auto put_hold = [&](std::size_t m, std::size_t neighbour) {
    const Vec3 way = all[neighbour].position - all[m].position;
    const double share = std::min(hold_share, hold / std::max(way.norm(), smallest_gap));
    put(all[m].position + share * way,
        all[m].radius + share * (all[neighbour].radius - all[m].radius));
  };
  for (std::size_t m = 0; m < count; ++m) {
    if (m > 0 && held(m, m - 1)) put_hold(m, m - 1);
    all[m].index = static_cast<int>(points.size());
    put(all[m].position, all[m].radius);
    if (m + 1 < count && held(m, m + 1)) put_hold(m, m + 1);
  }
  curve.points = std::move(points);
  if (varies) curve.radius = std::move(radius);
}

std::vector<Main>::iterator find(std::vector<Main>& all, int index) {
  return std::ranges::find_if(all, [index](const Main& one) { return one.index == index; });
}

/// The pieces beside a point are to be curved: neighbours that made them straight keep their bend.
void bend_pieces_beside(std::vector<Main>& all, std::size_t m) {
  const auto let_go = [&](std::size_t n) {
    const bool inner = n > 0 && n + 1 < all.size();
    if (all[n].kind == PointKind::linear)
      all[n].kind = inner ? PointKind::corner : PointKind::smooth;
  };
  if (m > 0) let_go(m - 1);
  if (m + 1 < all.size()) let_go(m + 1);
}

bool all_smooth(const std::vector<Main>& all) {
  return std::ranges::all_of(all,
                             [](const Main& one) { return !one.held_before && !one.held_behind; });
}

}  // namespace

std::vector<ControlPoint> control_points(const PlantCurve& curve) {
  std::vector<ControlPoint> points;
  for (const Main& one : mains_of(curve)) points.push_back({one.index, one.kind});
  return points;
}

PointKind point_kind(const PlantCurve& curve, int point) {
  for (const ControlPoint& one : control_points(curve))
    if (one.index == point) return one.kind;
  return PointKind::smooth;
}

int held_point(const PlantCurve& curve, int point) {
  return holders(curve).at(static_cast<std::size_t>(point));
}

int set_point_kind(PlantFile& plant, const std::string& stem, int point, PointKind kind) {
  const int index = find_stem(plant, stem);
  PlantCurve curve = plant.curves[index];
  check_point(curve, point);
  if (const int held = held_point(curve, point); held >= 0)
    throw UsageError("point " + std::to_string(point) + " of " + stem + " holds the corner at " +
                     std::to_string(held) + ", expected that one");
  if (kind == PointKind::corner && is_end(curve, point))
    throw UsageError("point " + std::to_string(point) + " of " + stem +
                     " is an end, expected one between two others");
  std::vector<Main> all = mains_of(curve);
  const auto one = find(all, point);
  one->kind = kind;
  if (curve.interpolation == Interpolation::linear && kind != PointKind::smooth) return point;
  curve.interpolation = Interpolation::smooth;
  if (kind == PointKind::smooth)
    bend_pieces_beside(all, static_cast<std::size_t>(one - all.begin()));
  lay(curve, all);
  const int now = one->index;
  replace_curve(plant, index, std::move(curve));
  return now;
}

int move_control_point(PlantCurve& curve, int point, const Vec3& to) {
  std::vector<Main> all = mains_of(curve);
  const auto one = find(all, point);
  if (one == all.end() || all_smooth(all)) {
    curve.points[point] = to;
    return point;
  }
  one->position = to;
  lay(curve, all);
  return one->index;
}

void remove_control_point(PlantCurve& curve, int point) {
  std::vector<Main> all = mains_of(curve);
  const auto one = find(all, point);
  if (one == all.end() || all_smooth(all)) {
    curve.points.erase(curve.points.begin() + point);
    if (curve.radius.size() > 1) curve.radius.erase(curve.radius.begin() + point);
    return;
  }
  all.erase(one);
  lay(curve, all);
}

}  // namespace pedicel::plant
