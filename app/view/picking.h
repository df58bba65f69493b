#pragma once

#include <optional>

#include "app/session/live/draw_surface.h"
#include "app/session/live/snapshot.h"
#include "app/ui/view_state.h"
#include "app/view/rigid_shapes.h"
#include "engine/geometry/ray.h"
#include "engine/render/camera.h"

namespace pedicel::app {

/// What a ray hits first, as it is drawn now (a stroke's depth on planes and surfaces is the
/// session's: draw_surface.h; places on stems as they are drawn in the file: plant_pick.h). A stem
/// may be missed by `slack` (rad, as seen from the eye), so that thin ones can be met; a leaf is
/// met at its rods and blades. Another part of a plant that is hit squarely is preferred to one
/// that is missed. Nothing hit: kind none, and `place_W` is where the ray meets the ground, or at
/// the target's depth.
Selection pick(const Snapshot& snapshot, const RigidShapes& shapes, const geometry::Ray& ray,
               double slack);

/// Distances along a ray (unit direction); negative where it misses.
double hit_sphere(const geometry::Ray& ray, const Vec3& centre, double radius);
/// A capsule's axis nearest to the ray: `along` is the fraction from `a` to `b`, `gap` the distance
/// between the ray and the axis (m), `distance` along the ray (m).
struct NearAxis {
  double along = 0.0, gap = 0.0, distance = 0.0;
};
NearAxis near_axis(const geometry::Ray& ray, const Vec3& a, const Vec3& b);
/// Moeller and Trumbore 1997; negative where it misses.
double hit_triangle(const geometry::Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace pedicel::app
