#pragma once

namespace pedicel::app {

struct Document;

/// Refuses a change that no simulation could hold, before anything is made of it: throws
/// UsageError for a stem longer than 1 km, or a plant of more than 250,000 nodes, where the
/// change made it so.
void check_bounds(const Document& before, const Document& after);

}  // namespace pedicel::app
