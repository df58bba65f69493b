#include "engine/render/draw_list.h"

#include <cmath>

namespace pedicel::render {

namespace {

/// Any unit vector across a unit vector.
Vec3 any_across(const Vec3& direction) {
  Vec3 axis = Vec3::UnitX();
  if (std::abs(direction.x()) > 0.6) axis = Vec3::UnitY();
  return direction.cross(axis).normalized();
}

/// Turns `side` with the tangent, by the smallest rotation that takes one tangent into the next.
Vec3 carried(const Vec3& side, const Vec3& from, const Vec3& to) {
  const Vec3 turned = Quat::FromTwoVectors(from, to) * side;
  const Vec3 across = turned - turned.dot(to) * to;
  return across.norm() > 1e-9 ? Vec3(across.normalized()) : any_across(to);
}

std::vector<TubePoint> without_coinciding(std::span<const TubePoint> points) {
  std::vector<TubePoint> kept;
  for (const TubePoint& point : points)
    if (kept.empty() || (point.position - kept.back().position).norm() > 1e-7)
      kept.push_back(point);
  return kept;
}

std::vector<Vec3> tangents_of(const std::vector<TubePoint>& points) {
  const std::size_t n = points.size();
  std::vector<Vec3> tangents(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 sum = Vec3::Zero();
    if (i > 0) sum += (points[i].position - points[i - 1].position).normalized();
    if (i + 1 < n) sum += (points[i + 1].position - points[i].position).normalized();
    // A chain that folds back on itself has no mean direction: keep the incoming one.
    if (sum.norm() < 1e-6) sum = points[i].position - points[i - 1].position;
    tangents[i] = sum.normalized();
  }
  return tangents;
}

void extend(Eigen::AlignedBox3d& box, const Vec3& centre, double radius) {
  box.extend(Vec3(centre - Vec3::Constant(radius)));
  box.extend(Vec3(centre + Vec3::Constant(radius)));
}

}  // namespace

void DrawList::add_tube(std::span<const TubePoint> points, float roughness, float specular) {
  const std::vector<TubePoint> kept = without_coinciding(points);
  if (kept.empty()) return;
  if (kept.size() == 1) {
    spheres.push_back({kept[0].position, kept[0].radius, {kept[0].colour, roughness, specular}});
    return;
  }
  const std::vector<Vec3> tangents = tangents_of(kept);
  Vec3 side = any_across(tangents[0]);
  for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
    const Vec3 next = carried(side, tangents[i], tangents[i + 1]);
    tubes.push_back({kept[i].position, kept[i + 1].position, tangents[i], tangents[i + 1], side,
                     next, kept[i].radius, kept[i + 1].radius, kept[i].colour, kept[i + 1].colour,
                     roughness, specular, i == 0 || i + 2 == kept.size()});
    side = next;
  }
}

void DrawList::add_arrow(const Vec3& tail, const Vec3& tip, double radius,
                         const Shading& material) {
  const double length = (tip - tail).norm();
  if (length < 1e-6) return;
  const Vec3 direction = (tip - tail) / length;
  const Vec3 neck = tip - direction * std::min(5.0 * radius, 0.5 * length);
  capsules.push_back({tail, neck, radius, radius, material});
  capsules.push_back({neck, tip, 2.2 * radius, 0.15 * radius, material});
}

void DrawList::clear() {
  capsules.clear();
  tubes.clear();
  spheres.clear();
  boxes.clear();
  meshes.clear();
  blades.clear();
  lines.clear();
  ghost.reset();
}

DrawList::Counts DrawList::counts() const {
  return {capsules.size(), tubes.size(),  spheres.size(),
          boxes.size(),    meshes.size(), blades.size()};
}

void DrawList::label_since(const Counts& before, Label label) {
  const auto name = [label](auto& items, std::size_t first) {
    for (std::size_t i = first; i < items.size(); ++i) items[i].label = label;
  };
  name(capsules, before.capsules);
  name(tubes, before.tubes);
  name(spheres, before.spheres);
  name(boxes, before.boxes);
  name(meshes, before.meshes);
  name(blades, before.blades);
}

Eigen::AlignedBox3d mesh_bounds(const geometry::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

Eigen::AlignedBox3d DrawList::bounds() const {
  Eigen::AlignedBox3d all;
  const auto extend_corners = [&](const Pose& pose, const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return;
    for (int corner = 0; corner < 8; ++corner)
      all.extend(pose * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  };
  for (const Capsule& c : capsules) extend(all, c.p0, c.r0), extend(all, c.p1, c.r1);
  for (const TubeSegment& t : tubes) extend(all, t.p0, t.r0), extend(all, t.p1, t.r1);
  for (const Sphere& s : spheres) extend(all, s.centre, s.radius);
  for (const Box& b : boxes) extend_corners(b.pose, {-b.half_extents, b.half_extents});
  for (const MeshInstance& m : meshes)
    if (m.mesh) extend_corners(m.pose, mesh_bounds(*m.mesh));
  for (const BladeFace& t : blades) all.extend(t.a).extend(t.b).extend(t.c);
  for (const Line& l : lines) all.extend(l.a).extend(l.b);
  return all;
}

}  // namespace pedicel::render
