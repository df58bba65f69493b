#include "engine/geometry/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/stop.h"

namespace pedicel::geometry {

namespace {

constexpr int kLeafSize = 4;
/// Halving the triangles at each level keeps the depth below 32 for any count that fits an int.
constexpr int kDepth = 64;
/// A group acts as a dipole from this many radii on (Barill et al. use 2).
constexpr double kFar = 2.0;

/// Signed solid angle of a triangle seen from p (A. van Oosterom, J. Strackee, IEEE Trans. Biomed.
/// Eng. 30, 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double numerator = a.dot(b.cross(c));
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2.0 * std::atan2(numerator, denominator);
}

}  // namespace

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw UsageError("TriangleBvh: the mesh has no triangles");
  corners_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    corners_.push_back(
        {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], static_cast<int>(i)});
  }
  build(0, static_cast<int>(corners_.size()));
}

void TriangleBvh::build(int first, int count) {
  throw_if_stopped();
  const std::size_t self = nodes_.size();
  Node node;
  Aabb centres;
  for (int i = first; i < first + count; ++i) {
    const Corners& t = corners_[i];
    node.box.extend(t.a).extend(t.b).extend(t.c);
    centres.extend(t.a + t.b + t.c);
  }
  node.first = first;
  node.count = count;
  nodes_.push_back(node);
  dipoles_.push_back(dipole(first, count));
  if (count <= kLeafSize) return;

  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto key = [axis](const Corners& t) {
    return std::pair(t.a[axis] + t.b[axis] + t.c[axis], t.triangle);
  };
  const auto begin = corners_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](const Corners& s, const Corners& t) { return key(s) < key(t); });
  build(first, count / 2);
  nodes_[self].second_child = static_cast<int>(nodes_.size());
  build(first + count / 2, count - count / 2);
}

TriangleBvh::Dipole TriangleBvh::dipole(int first, int count) const {
  Dipole result{Vec3::Zero(), Vec3::Zero(), 0.0};
  double total = 0.0;
  for (int i = first; i < first + count; ++i) {
    const Corners& t = corners_[i];
    const Vec3 area = 0.5 * (t.b - t.a).cross(t.c - t.a);
    result.area += area;
    result.centre += area.norm() * (t.a + t.b + t.c) / 3.0;
    total += area.norm();
  }
  result.centre = total > 0.0 ? Vec3(result.centre / total) : corners_[first].a;
  for (int i = first; i < first + count; ++i) {
    const Corners& t = corners_[i];
    for (const Vec3* corner : {&t.a, &t.b, &t.c})
      result.radius = std::max(result.radius, (*corner - result.centre).norm());
  }
  return result;
}

TriangleBvh::Nearest TriangleBvh::nearest(const Vec3& p, double bound) const {
  Nearest best;
  best.squared_distance = bound * bound;
  struct Entry {
    int node;
    double squared_distance;
  };
  Entry stack[kDepth];
  int size = 0;
  stack[size++] = {0, nodes_[0].box.squaredExteriorDistance(p)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared_distance >= best.squared_distance) continue;
    const Node& node = nodes_[entry.node];
    if (node.second_child >= 0) {
      Entry near{entry.node + 1, nodes_[entry.node + 1].box.squaredExteriorDistance(p)};
      Entry far{node.second_child, nodes_[node.second_child].box.squaredExteriorDistance(p)};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = corners_[i];
      const TrianglePoint at = closest_on_triangle(p, t.a, t.b, t.c);
      const double squared_distance = (p - at.point).squaredNorm();
      if (squared_distance < best.squared_distance) best = {t.triangle, at, squared_distance};
    }
  }
  return best;
}

double TriangleBvh::winding_number(const Vec3& p) const {
  double angle = 0.0;
  int stack[kDepth];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const int self = stack[--size];
    const Dipole& group = dipoles_[self];
    const Vec3 r = group.centre - p;
    const double distance = r.norm();
    if (distance > kFar * group.radius) {
      angle += group.area.dot(r) / (distance * distance * distance);
      continue;
    }
    const Node& node = nodes_[self];
    if (node.second_child >= 0) {
      stack[size++] = node.second_child;
      stack[size++] = self + 1;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = corners_[i];
      angle += solid_angle(t.a - p, t.b - p, t.c - p);
    }
  }
  return angle / (4.0 * std::numbers::pi);
}

}  // namespace pedicel::geometry
