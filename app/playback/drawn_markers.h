#pragma once

#include "engine/render/draw_list.h"
#include "engine/ros_messages/marker_messages.h"

namespace pedicel::app {

/// Markers that stand between two messages: `share` 0 is the first, 1 the second. Where the second
/// has other markers, or other numbers of points, the first stands.
ros::MarkerArray between(const ros::MarkerArray& before, const ros::MarkerArray& after,
                         double share);

/// Adds what markers show: boxes, spheres, cylinders, lines, lists of spheres and of triangles.
/// Other kinds, texts, and what has no size or no place within 1000 km are left out. Frames are
/// taken for the world's.
void add_markers(render::DrawList& list, const ros::MarkerArray& markers);

}  // namespace pedicel::app
