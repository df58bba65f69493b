#pragma once

#include "app/panels/view_state.h"
#include "session/snapshot.h"

namespace pedicel::app {

/// What was chosen in one snapshot, in another: found again by the names of plant, organ, link or
/// body, and by the share of the organ's length, since numbers change with every edit and every
/// sampling. A fruit that came off is the body that it became, and the other way round. Nothing is
/// chosen where there is no such thing any more.
Selection follow_selection(const Selection& selection, const Snapshot& before,
                           const Snapshot& after);

/// The organ of a plant that is chosen as a stem, wherever it was chosen (index into its organs);
/// -1: none.
int chosen_organ(const Selection& selection, const cosserat::RodModel& model, int plant);

}  // namespace pedicel::app
