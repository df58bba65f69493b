#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/diagnostics.h"
#include "engine/robot/description.h"
#include "engine/urdf/package_paths.h"

namespace pedicel::robot {

/// Reads a URDF: urdfdom parses it, after every value has been checked against the XML itself,
/// because urdfdom drops or zeroes what it cannot read. Faults go to `diagnostics` with line and
/// column, and nothing comes back; missing masses and inertias are warnings, once per link, that
/// state the substitute (substitute_inertia.h). Meshes are found and loaded.
std::optional<RobotDescription> read_urdf(const std::filesystem::path& path,
                                          const PackagePaths& packages, Diagnostics& diagnostics);

/// The same from text; `path` stands for the file in messages and relative mesh names.
std::optional<RobotDescription> parse_urdf(const std::string& text,
                                           const std::filesystem::path& path,
                                           const PackagePaths& packages, Diagnostics& diagnostics);

/// The same with packages from the environment, for callers that need the robot whole. Throws
/// InvalidFile with all faults.
RobotDescription load_urdf(const std::filesystem::path& path,
                           const PackagePaths& packages = PackagePaths::from_environment());

}  // namespace pedicel::robot
