#pragma once

#include <Eigen/Geometry>

#include "app/ui/ui.h"
#include "app/view/rigid_shapes.h"

namespace pedicel::app {

/// The box (m, W) that shows what is chosen, with something of what is about it: a control point
/// with the way to its neighbours, a stem as it is simulated (as it is drawn where it is not), a
/// fruit, a link, a body. Empty where nothing is chosen.
Eigen::AlignedBox3d frame_of(const Ui& ui, const RigidShapes& shapes);

}  // namespace pedicel::app
