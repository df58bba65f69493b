#pragma once

#include "app/session/live/snapshot.h"
#include "app/ui/view_state.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

/// Adds what is not a thing of the scene: arrows of contact and pulling forces, frames, rods as
/// lines, where something has just come off, what made it unstable.
void add_marks(render::DrawList& list, const Snapshot& snapshot, const ViewState& view);

/// What came off in the last second and a half of the run, a few of it, the newest first: it is
/// marked where it happened.
std::vector<world::Event> recent_breaks(const Snapshot& snapshot);

/// A cage about a chosen (or only pointed at) fruit, link or body; stems change their colour.
void add_selection(render::DrawList& list, const Eigen::AlignedBox3d& box,
                   const Selection& selection, bool chosen);

/// Three lines along the axes of a pose, red, green, blue.
void add_axes(render::DrawList& list, const Pose& X_WF, double length);

/// The twelve edges of a box in the world.
void add_cage(render::DrawList& list, const Eigen::AlignedBox3d& box, const render::Colour& colour,
              float width);

}  // namespace pedicel::app
