#pragma once

#include <string>
#include <vector>

#include "app/session/document/document_parameters.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::app {

/// Whether a key of `set` changes plants (and not the solver, the contacts or the scene).
bool is_plant_key(const std::string& key);

/// The parameters of a plant that may be set over what its file says, with what they are now
/// (`now`: the scene's overrides) and would be without the document's settings (`files`). Those
/// that the plant has no use for (thresholds without fruits) are left out.
void add_plant_parameters(std::vector<SessionParameter>& all, const std::string& name,
                          const plant::PlantFile& plant, const std::vector<world::Setting>& now,
                          const std::vector<world::Setting>& files);

}  // namespace pedicel::app
