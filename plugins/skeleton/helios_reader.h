#pragma once

#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/skeleton/helios_plant.h"

namespace pedicel::plant {

/// The shoots and petioles of a plant structure that Helios wrote as XML (<helios> with one
/// <plant_instance>), see helios_nodes(). Lengths are in `unit` (m) where the caller says it, else
/// in m, as Helios has them. Helios keeps the gravitropic curvature of shoots out of its file, so
/// that they come out straighter than there: a warning says so where it counts, and what is not
/// read. Empty after an error; `file` stands for the file in errors.
std::vector<SkeletonNode> parse_helios_xml(const std::string& text, const std::string& file,
                                           Diagnostics& diagnostics, double unit = 0.0);

/// Whether a text is XML whose first element is <helios>.
bool is_helios_xml(const std::string& text);

}  // namespace pedicel::plant
