#pragma once

#include <filesystem>
#include <string>

#include "engine/cluster/cluster_options.h"
#include "engine/core/diagnostics.h"

namespace pedicel::cluster {

/// Reads a profile: what all runs on one cluster have in common. Throws InvalidFile.
ClusterOptions read_profile(const std::filesystem::path& path);
ClusterOptions parse_profile(const std::string& text, const std::string& name,
                             Diagnostics& diagnostics);

/// What `given` leaves open is taken from the profile.
void take_profile(const ClusterOptions& profile, ClusterOptions& given);

}  // namespace pedicel::cluster
