#pragma once

#include <optional>
#include <string>

#include "app/session/live/snapshot.h"
#include "engine/geometry/ray.h"
#include "plugins/coupling/collider.h"

/// From rays to places in the world: what a stroke is drawn on.
namespace pedicel::app {

struct DrawPlane {
  Vec3 point = Vec3::Zero();    ///< m, W
  Vec3 normal = Vec3::UnitZ();  ///< unit, W
};
/// Upright, through a point, and faces the view as well as that allows; seen from straight above or
/// below it faces the view.
DrawPlane upright_plane(const Vec3& view_direction, const Vec3& point);
/// Faces the view, through a point.
DrawPlane view_plane(const Vec3& view_direction, const Vec3& point);
DrawPlane ground_plane(double height);
/// Holds a stem's direction and faces the view as well as that allows.
DrawPlane tangent_plane(const Vec3& tangent, const Vec3& view_direction, const Vec3& point);
/// Where a ray meets a plane in front of it; nothing where it runs along it (within 1e-3 rad).
std::optional<Vec3> meet(const geometry::Ray& ray, const DrawPlane& plane);

struct SurfaceHit {
  Vec3 point = Vec3::Zero();    ///< m, W
  Vec3 normal = Vec3::UnitZ();  ///< unit, outward
  double depth = 0.0;           ///< m along the ray
  std::string name;             ///< of the body, link or ground
};

/// Bodies, robot and ground as they stand in a snapshot.
class Surfaces {
 public:
  explicit Surfaces(const Snapshot& snapshot);
  /// The first surface that a ray meets within `reach` (m): sphere tracing (J. C. Hart, The Visual
  /// Computer 12, 1996, 527-545) through the distance fields that the plants feel.
  std::optional<SurfaceHit> hit(const geometry::Ray& ray, double reach = 20.0) const;

 private:
  coupling::ColliderSet colliders_;
};

enum class StrokePlane { upright, view, ground, tangent, surface };

struct ProjectorOptions {
  StrokePlane plane = StrokePlane::upright;
  bool only_first = true;  ///< on surfaces: the depth of the first place counts for the stroke
  double offset = 0.0;     ///< m, above the surface
  double ground = 0.0;     ///< m, its height
};

/// Turns the rays of one stroke into places. The stroke's start decides its depth: on a stem, on a
/// surface, or at `fallback`.
class StrokeProjector {
 public:
  /// `snapped`: the place on a stem where it begins (m, W), and `tangent` the stem's direction
  /// there. `surfaces` must outlive it; null: there are none.
  StrokeProjector(const ProjectorOptions& options, const Vec3& view_direction,
                  const Surfaces* surfaces);
  void start_on_stem(const Vec3& point, const Vec3& tangent);
  /// A place for the depth where a stroke starts on nothing (the cursor, the orbit's centre).
  void set_fallback(const Vec3& point) { fallback_ = point; }

  /// Nothing where the ray meets nothing to draw on.
  std::optional<Vec3> place(const geometry::Ray& ray);
  /// The plane that the stroke has settled on, to be shown; nothing on surfaces.
  const std::optional<DrawPlane>& plane() const { return plane_; }

 private:
  void choose_plane(const geometry::Ray& ray);
  std::optional<Vec3> on_surface(const geometry::Ray& ray) const;

  ProjectorOptions options_;
  Vec3 view_direction_, fallback_ = Vec3::Zero();
  const Surfaces* surfaces_;
  std::optional<Vec3> start_, tangent_;
  std::optional<DrawPlane> plane_;
  bool begun_ = false;
};

}  // namespace pedicel::app
