#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/frames.h"

namespace pedicel::world {

/// A convex piece of a body, in the body's frame. Only the extents of its own kind count.
struct BodyPart {
  enum class Kind { box, sphere, cylinder, capsule };
  Kind kind = Kind::box;
  Pose pose;                         ///< part to body
  Vec3 half_extents = Vec3::Zero();  ///< m, box
  double radius = 0.0;               ///< m
  double length = 0.0;               ///< m, along Z: cylinder; capsule without its caps
};

/// A rigid thing. A body without mass does not move.
struct BodyDescription {
  std::string name;
  std::vector<BodyPart> parts;
  double mass = 0.0;                     ///< kg, 0: static
  Pose pose;                             ///< X_W
  double friction = 0.6;                 ///< 1, Coulomb; Bullet multiplies the two bodies' values
  double restitution = 0.1;              ///< 1
  Vec3 velocity = Vec3::Zero();          ///< m/s, W, at the start
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s, W
  std::string look = "steel";            ///< how it is drawn: one of body_looks()
};

struct GroundPlane {
  double height = 0.0;       ///< m
  double friction = 0.8;     ///< 1
  double restitution = 0.0;  ///< 1; Bullet multiplies it with the body's
};

/// The words that `look:` takes.
const std::vector<std::string>& body_looks();

/// An open box: floor and four walls of thickness `wall`. Its origin is the middle of the floor's
/// lower face. `size` is the outside.
std::vector<BodyPart> tray_parts(const Vec3& size, double wall);

/// A fruit that has come off: a sphere at the body's origin, and the stub of its stalk, a capsule
/// that ends in the sphere, along the body's -Z (towards where the stalk came from).
BodyDescription fruit_body(const std::string& name, double radius, double mass, double stub_length,
                           double stub_radius);

/// The box that encloses a body in its own frame (lower and upper corner).
std::pair<Vec3, Vec3> bounds_of(const BodyDescription& body);

}  // namespace pedicel::world
