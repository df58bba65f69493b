#pragma once

#include "app/colliders.h"

namespace pedicel::app {

/// Like fields_of(), but exact for meshes, too, without grids: where there are no plants, nobody
/// asks for thousands of distances a step, but the window picks and draws on robots.
ShapeFields exact_fields_of(const robot::RobotDescription& robot);

}  // namespace pedicel::app
