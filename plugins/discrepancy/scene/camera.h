#pragma once

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// px, where a camera sees a point (m, W); NaN for one that is not in front of it. The picture's
/// edges do not count: what was seen is the data's affair.
Eigen::Vector2d image_of(const Camera& camera, const Vec3& point_W);

/// Where on the plane at z = 1 in front of a camera a place of its picture (px) looks: x/z and y/z
/// of all points that are seen there. NaN where the distortion cannot be undone.
Eigen::Vector2d direction_of(const Camera& camera, const Eigen::Vector2d& pixel);

/// Rotation of a camera at `eye` that looks at `target` with the world's Z upward: x right, y down,
/// z forward.
Quat looking_at(const Vec3& eye, const Vec3& target);

}  // namespace pedicel::discrepancy
