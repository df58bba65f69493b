#pragma once

#include <optional>

#include "app/session/live/snapshot.h"
#include "app/ui/view_state.h"

namespace pedicel::app {

/// What was chosen in one snapshot, in another: found again by the names of plant, organ, link or
/// body, and by the share of the organ's length, since numbers change with every edit and every
/// sampling. A fruit that came off is the body that it became, and the other way round. Nothing is
/// chosen where there is no such thing any more.
Selection follow_selection(const Selection& selection, const Snapshot& before,
                           const Snapshot& after);

/// Where the chosen thing is, m, W: a fruit's middle, the place of a stem that was clicked on or
/// its middle, a body, a link; nothing where it is not there.
std::optional<Vec3> place_of(const Selection& selection, const Snapshot& snapshot);

/// 0 to 1, from the organ's foot: where a place lies that is `back` (m) before an element's end.
double share_along(const cosserat::RodModel& model, int element, double back);

/// A fruit on its plant, the body that it became, a stem or a leaf: "tomato/fruit_3"; nothing where
/// there is none of that name.
Selection select_organ(const std::string& organ, const Snapshot& snapshot);

/// The organ of a plant that is chosen as a stem, wherever it was chosen (index into its organs);
/// -1: none.
int chosen_organ(const Selection& selection, const cosserat::RodModel& model, int plant);

}  // namespace pedicel::app
