#include "app/view/picking.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;

void take(Selection& best, Selection found) {
  if (!best || found.distance < best.distance) best = std::move(found);
}

void pick_stems(Selection& hit, Selection& missed, const Snapshot& snapshot, int p,
                const geometry::Ray& ray, double slack) {
  const PlantSnapshot& plant = snapshot.plants[static_cast<std::size_t>(p)];
  const cosserat::RodModel& model = *plant.model;
  for (int e = 0; e < model.size(); ++e) {
    if (!plant.state.alive[e]) continue;
    const Vec3 a = start_of(model, plant.state, e), b = plant.state.position[e];
    const NearAxis near = near_axis(ray, a, b);
    const double radius = std::max(model.elements[e].radius_near, model.elements[e].radius_far);
    if (near.distance <= 0.0 || near.gap > radius + slack * near.distance) continue;
    Selection found;
    found.kind = Kind::element;
    found.plant = p, found.element = e;
    found.back = (1.0 - near.along) * model.elements[e].length;
    found.place_W = a + near.along * (b - a);
    found.distance = near.distance - radius;
    take(near.gap <= radius ? hit : missed, found);
  }
}

void pick_fruits(Selection& best, const Snapshot& snapshot, int p, const geometry::Ray& ray) {
  const PlantSnapshot& plant = snapshot.plants[static_cast<std::size_t>(p)];
  const cosserat::RodModel& model = *plant.model;
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
    if (plant.state.fruit_gone[static_cast<std::size_t>(f)]) continue;
    const cosserat::Fruit& fruit = model.fruits[static_cast<std::size_t>(f)];
    const Vec3 centre = point_on(model, plant.state, fruit.element, fruit.back);
    const double distance = hit_sphere(ray, centre, fruit.radius);
    if (distance < 0.0) continue;
    Selection found;
    found.kind = Kind::fruit;
    found.plant = p, found.fruit = f, found.element = fruit.element;
    found.back = fruit.back;
    found.place_W = ray.origin + distance * ray.direction;
    found.distance = distance;
    take(best, found);
  }
}

/// Only where nothing else is: a string ends in the stem that it holds.
void pick_ties(Selection& best, const Snapshot& snapshot, const geometry::Ray& ray, double slack) {
  for (const TieSnapshot& tie : snapshot.ties) {
    const Vec3 &a = tie.course.from_W, &b = tie.course.to_W;
    const NearAxis near = near_axis(ray, a, b);
    if (near.distance <= 0.0 || near.gap > slack * near.distance) continue;
    Selection found;
    found.kind = Kind::tie;
    found.tie = tie.number;
    found.place_W = a + near.along * (b - a);
    found.distance = near.distance;
    take(best, found);
  }
}

/// A leaf's blade stands for the element at its first corner.
void pick_blades(Selection& best, const Snapshot& snapshot, int p, const geometry::Ray& ray) {
  if (static_cast<std::size_t>(p) >= snapshot.assets->plants.size()) return;
  const PlantSnapshot& plant = snapshot.plants[static_cast<std::size_t>(p)];
  for (const simulation::Blade& blade :
       snapshot.assets->plants[static_cast<std::size_t>(p)].blades) {
    std::array<Vec3, 3> corner;
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      whole =
          whole && blade[k].element < plant.model->size() && plant.state.alive[blade[k].element];
      if (!whole) break;
      corner[k] = point_on(*plant.model, plant.state, blade[k].element, blade[k].back);
    }
    const double distance = whole ? hit_triangle(ray, corner[0], corner[1], corner[2]) : -1.0;
    if (distance < 0.0) continue;
    Selection found;
    found.kind = Kind::element;
    found.plant = p, found.element = blade[0].element, found.back = blade[0].back;
    found.place_W = ray.origin + distance * ray.direction;
    found.distance = distance;
    take(best, found);
  }
}

double hit_box(const geometry::Ray& ray, const render::Box& box) {
  const Pose to_box = box.pose.inverse();
  const Vec3 o = to_box * ray.origin, d = to_box.rotation * ray.direction;
  double from = 0.0, to = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double a = (-box.half_extents[i] - o[i]) / d[i], b = (box.half_extents[i] - o[i]) / d[i];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to ? from : -1.0;
}

double hit_mesh(const geometry::Ray& ray, const render::MeshInstance& instance) {
  const Pose to_mesh = instance.pose.inverse();
  const geometry::Ray local{to_mesh * ray.origin, to_mesh.rotation * ray.direction};
  double best = -1.0;
  for (const auto& t : instance.mesh->triangles) {
    const auto& v = instance.mesh->vertices;
    const double distance =
        hit_triangle(local, v[static_cast<std::size_t>(t[0])], v[static_cast<std::size_t>(t[1])],
                     v[static_cast<std::size_t>(t[2])]);
    if (distance >= 0.0 && (best < 0.0 || distance < best)) best = distance;
  }
  return best;
}

/// The nearest hit of a rigid shape, given in its own frame; negative: none.
double hit_shape(const geometry::Ray& ray, const RigidShapes::Shape& rigid, const Pose& X_WS) {
  const render::DrawList& shape = rigid.list;
  const Pose to_shape = X_WS.inverse();
  const geometry::Ray local{to_shape * ray.origin, to_shape.rotation * ray.direction};
  const Eigen::AlignedBox3d& box = rigid.box;
  if (box.isEmpty() || hit_sphere(local, box.center(), 0.5 * box.diagonal().norm()) < 0.0)
    return -1.0;
  double best = -1.0;
  const auto better = [&best](double distance) {
    if (distance >= 0.0 && (best < 0.0 || distance < best)) best = distance;
  };
  for (const render::Sphere& s : shape.spheres) better(hit_sphere(local, s.centre, s.radius));
  for (const render::Box& b : shape.boxes) better(hit_box(local, b));
  for (const render::MeshInstance& m : shape.meshes)
    if (m.mesh) better(hit_mesh(local, m));
  for (const render::Capsule& c : shape.capsules) {
    const NearAxis near = near_axis(local, c.p0, c.p1);
    if (near.gap <= std::max(c.r0, c.r1)) better(near.distance - std::max(c.r0, c.r1));
  }
  return best;
}

void pick_rigid(Selection& best, const Snapshot& snapshot, const RigidShapes& shapes,
                const geometry::Ray& ray) {
  const auto consider = [&](Kind kind, std::size_t index, double distance) {
    if (distance < 0.0) return;
    Selection found;
    found.kind = kind;
    (kind == Kind::link ? found.link : found.body) = static_cast<int>(index);
    found.distance = distance;
    found.place_W = ray.origin + distance * ray.direction;
    take(best, found);
  };
  for (std::size_t l = 0; l < std::min(shapes.links().size(), snapshot.robot.links.size()); ++l)
    consider(Kind::link, l, hit_shape(ray, shapes.links()[l], snapshot.robot.links[l]));
  for (std::size_t b = 0; b < std::min(shapes.bodies().size(), snapshot.bodies.size()); ++b)
    consider(Kind::body, b, hit_shape(ray, shapes.bodies()[b], snapshot.bodies[b].pose));
}

}  // namespace

double hit_sphere(const geometry::Ray& ray, const Vec3& centre, double radius) {
  const Vec3 offset = ray.origin - centre;
  const double b = offset.dot(ray.direction);
  const double c = offset.squaredNorm() - radius * radius;
  const double root = b * b - c;
  if (root < 0.0) return -1.0;
  const double near = -b - std::sqrt(root), far = -b + std::sqrt(root);
  return near >= 0.0 ? near : (far >= 0.0 ? 0.0 : -1.0);
}

NearAxis near_axis(const geometry::Ray& ray, const Vec3& a, const Vec3& b) {
  const Vec3 axis = b - a, offset = a - ray.origin;
  const double length2 = axis.squaredNorm();
  const double d = axis.dot(ray.direction);
  const double across = length2 - d * d;  // axis x direction, squared
  double along = 0.0;
  if (across > 1e-12 * length2)
    along = std::clamp((d * offset.dot(ray.direction) - offset.dot(axis)) / across, 0.0, 1.0);
  const Vec3 place = a + along * axis;
  const double distance = (place - ray.origin).dot(ray.direction);
  return {along, (place - ray.origin - distance * ray.direction).norm(), distance};
}

double hit_triangle(const geometry::Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 p = ray.direction.cross(ac);
  const double det = ab.dot(p);
  if (std::abs(det) < 1e-18) return -1.0;
  const Vec3 t = ray.origin - a;
  const double u = t.dot(p) / det;
  if (u < 0.0 || u > 1.0) return -1.0;
  const Vec3 q = t.cross(ab);
  const double v = ray.direction.dot(q) / det;
  if (v < 0.0 || u + v > 1.0) return -1.0;
  return ac.dot(q) / det;
}

Selection pick(const Snapshot& snapshot, const RigidShapes& shapes, const geometry::Ray& ray,
               double slack) {
  Selection best, missed;
  if (snapshot.assets) {
    for (int p = 0; p < static_cast<int>(snapshot.plants.size()); ++p) {
      pick_fruits(best, snapshot, p, ray);
      pick_blades(best, snapshot, p, ray);
      pick_stems(best, missed, snapshot, p, ray, slack);
    }
    if (!best) best = missed;
    pick_rigid(best, snapshot, shapes, ray);
    if (!best) pick_ties(best, snapshot, ray, slack);
  }
  if (best) return best;
  const double ground = snapshot.assets && snapshot.assets->scene.ground
                            ? snapshot.assets->scene.ground->height
                            : 0.0;
  const auto floor = meet(ray, ground_plane(ground));
  best.distance = floor ? (*floor - ray.origin).norm() : 2.0;
  best.place_W = ray.origin + best.distance * ray.direction;
  return best;
}

}  // namespace pedicel::app
