#include "app/session/live/draw_surface.h"

#include <cmath>

#include "plugins/simulation/colliders.h"

namespace pedicel::app {

DrawPlane upright_plane(const Vec3& view_direction, const Vec3& point) {
  constexpr double steepest = 0.17;  // cosine, 10 degrees from straight down
  const Vec3 level(view_direction.x(), view_direction.y(), 0.0);
  if (level.norm() < steepest * view_direction.norm()) return view_plane(view_direction, point);
  return {point, -level.normalized()};
}

DrawPlane view_plane(const Vec3& view_direction, const Vec3& point) {
  return {point, -view_direction.normalized()};
}

DrawPlane ground_plane(double height) {
  return {Vec3(0, 0, height), Vec3::UnitZ()};
}

DrawPlane tangent_plane(const Vec3& tangent, const Vec3& view_direction, const Vec3& point) {
  const Vec3 along = tangent.normalized();
  const Vec3 facing = view_direction - view_direction.dot(along) * along;
  if (facing.norm() < 1.0e-6) return view_plane(view_direction, point);  // seen along the stem
  return {point, -facing.normalized()};
}

std::optional<Vec3> meet(const geometry::Ray& ray, const DrawPlane& plane) {
  const double slope = ray.direction.dot(plane.normal);
  if (std::abs(slope) < 1.0e-3) return std::nullopt;
  const double depth = (plane.point - ray.origin).dot(plane.normal) / slope;
  if (depth <= 0.0) return std::nullopt;
  return ray.at(depth);
}

Surfaces::Surfaces(const Snapshot& snapshot) {
  if (!snapshot.assets) return;
  if (snapshot.assets->scene.ground)
    simulation::add_ground_collider(colliders_, *snapshot.assets->scene.ground);
  for (std::size_t b = 0; b < snapshot.bodies.size(); ++b)
    simulation::add_body_colliders(colliders_, snapshot.bodies[b].info->description,
                                   static_cast<int>(b), snapshot.bodies[b].pose);
  if (snapshot.robot.present)
    simulation::add_robot_colliders(colliders_, snapshot.assets->scene.robot->name,
                                    *snapshot.assets->robot, snapshot.assets->robot_fields,
                                    snapshot.robot.links);
}

std::optional<SurfaceHit> Surfaces::hit(const geometry::Ray& ray, double reach) const {
  constexpr double close = 1.0e-5;  // m
  std::optional<SurfaceHit> best;
  for (int c = 0; c < colliders_.size(); ++c) {
    const Pose X_WC = colliders_.placement(c).X_WC, X_CW = X_WC.inverse();
    const Vec3 origin = X_CW * ray.origin, direction = X_CW.rotation * ray.direction;
    const double farthest = best ? best->depth : reach;
    double depth = 0.0;
    Vec3 normal = Vec3::UnitZ();
    for (int i = 0; i < 400 && depth < farthest; ++i) {
      const double distance =
          colliders_.collider(c).shape->distance(origin + depth * direction, &normal);
      if (distance < close) break;
      depth += distance;
    }
    const double left = colliders_.collider(c).shape->distance(origin + depth * direction, &normal);
    if (depth >= farthest || left > 100.0 * close) continue;
    best = SurfaceHit{ray.at(depth), X_WC.rotation * normal, depth, colliders_.collider(c).name};
  }
  return best;
}

StrokeProjector::StrokeProjector(const ProjectorOptions& options, const Vec3& view_direction,
                                 const Surfaces* surfaces)
    : options_(options), view_direction_(view_direction.normalized()), surfaces_(surfaces) {}

void StrokeProjector::start_on_stem(const Vec3& point, const Vec3& tangent) {
  start_ = point;
  tangent_ = tangent;
}

std::optional<Vec3> StrokeProjector::on_surface(const geometry::Ray& ray) const {
  const auto hit = surfaces_ ? surfaces_->hit(ray) : std::nullopt;
  if (!hit) return std::nullopt;
  return Vec3(hit->point + options_.offset * hit->normal);
}

void StrokeProjector::choose_plane(const geometry::Ray& ray) {
  begun_ = true;
  if (options_.plane == StrokePlane::ground) {
    plane_ = ground_plane(options_.ground + options_.offset);
  } else if (options_.plane == StrokePlane::tangent && start_) {
    plane_ = tangent_plane(*tangent_, view_direction_, *start_);
  } else if (options_.plane == StrokePlane::surface) {
    const auto first = start_ ? start_ : on_surface(ray);
    if (options_.only_first || !first)
      plane_ = view_plane(view_direction_, first.value_or(fallback_));
  } else if (options_.plane == StrokePlane::view) {
    plane_ = view_plane(view_direction_, start_.value_or(fallback_));
  } else {
    plane_ = upright_plane(view_direction_, start_.value_or(fallback_));
  }
}

std::optional<Vec3> StrokeProjector::place(const geometry::Ray& ray) {
  if (!begun_) {
    choose_plane(ray);
    if (start_) return start_;  // exactly where the snap was shown
  }
  return plane_ ? meet(ray, *plane_) : on_surface(ray);
}

}  // namespace pedicel::app
