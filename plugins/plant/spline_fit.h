#pragma once

#include <vector>

#include "engine/core/frames.h"

namespace pedicel::plant {

/// Control points of a centripetal Catmull-Rom spline (as geometry::Curve::smooth() has it) that
/// runs within `tolerance` (m) of all samples, from the first to the last of them, with as few
/// points as the loop of stroke_fit.h finds. Samples stand apart; two come back as they are.
std::vector<Vec3> fit_spline(const std::vector<Vec3>& samples, double tolerance);

}  // namespace pedicel::plant
