#pragma once

#include "engine/geometry/mesh.h"

/// Closed meshes of simple shapes, centred at the origin, axis along z, triangles counter-clockwise
/// seen from outside. Vertices of round parts lie on the true surface, so the mesh lies inside it
/// by at most radius (1 - cos(pi / segments)). Sizes in metres. A size that is not positive, or
/// fewer than 3 segments, is a UsageError.
namespace pedicel::geometry {

/// A box with the given full edge lengths.
TriangleMesh make_box(const Vec3& size);

/// A cylinder between z = -length/2 and z = length/2.
TriangleMesh make_cylinder(double radius, double length, int segments = 24);

/// A sphere of `segments` meridians and segments/2 rings.
TriangleMesh make_sphere(double radius, int segments = 24);

/// A cylinder of `length` (without the caps) with a half sphere on each end.
TriangleMesh make_capsule(double radius, double length, int segments = 24);

}  // namespace pedicel::geometry
