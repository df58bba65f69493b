#pragma once

#include <optional>

#include "app/panels/view_state.h"
#include "app/window/rigid_shapes.h"
#include "render/camera.h"
#include "session/snapshot.h"

namespace pedicel::app {

/// What a ray hits first. A stem may be missed by `slack` (rad, as seen from the eye), so that thin
/// ones can be met; another part of a plant that is hit squarely is preferred to one that is
/// missed. Nothing hit: kind none, and `place_W` is where the ray meets the ground, or at the
/// target's depth.
Selection pick(const Snapshot& snapshot, const RigidShapes& shapes, const render::Ray& ray,
               double slack);

/// Distances along a ray (unit direction); negative where it misses.
double hit_sphere(const render::Ray& ray, const Vec3& centre, double radius);
/// A capsule's axis nearest to the ray: `along` is the fraction from `a` to `b`, `gap` the distance
/// between the ray and the axis (m), `distance` along the ray (m).
struct NearAxis {
  double along = 0.0, gap = 0.0, distance = 0.0;
};
NearAxis near_axis(const render::Ray& ray, const Vec3& a, const Vec3& b);
/// Moeller and Trumbore 1997; negative where it misses.
double hit_triangle(const render::Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c);
/// Where a ray meets the plane through a point with that normal; nothing where it does not.
std::optional<Vec3> hit_plane(const render::Ray& ray, const Vec3& point, const Vec3& normal);

}  // namespace pedicel::app
