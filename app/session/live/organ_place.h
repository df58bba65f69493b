#pragma once

#include <optional>
#include <string>

#include "app/session/live/pull.h"
#include "app/session/live/snapshot.h"

namespace pedicel::app {

/// Where an organ is in the rods: a fruit by "PLANT/FRUIT" (its centre), a stem by "PLANT/STEM" and
/// the fraction `at` of its rods' length, from its foot.
std::optional<PullPlace> find_organ(const Snapshot& snapshot, const std::string& organ, double at);
/// Where a scene's anchor is now, m, W; nothing where it is not there.
std::optional<Vec3> place_of(const Snapshot& snapshot, const world::Anchor& anchor);
/// Where what an event tells of came off, m, W: what is left of its stalk; nothing where there is
/// no such fruit.
std::optional<Vec3> place_of_break(const Snapshot& snapshot, const world::Event& event);
/// What can be found, comma separated, shortened.
std::string organ_names(const Snapshot& snapshot);

}  // namespace pedicel::app
