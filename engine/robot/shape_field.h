#pragma once

#include <memory>

#include "engine/geometry/shapes.h"
#include "engine/robot/description.h"

namespace pedicel::robot {

/// Signed distance (m) to a shape in its own frame; null for a mesh, whose field is built apart.
std::shared_ptr<const geometry::SignedDistance> shape_field(const Geometry& shape);

}  // namespace pedicel::robot
