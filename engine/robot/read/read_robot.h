#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/diagnostics.h"
#include "engine/robot/description.h"
#include "engine/urdf/package_paths.h"

namespace pedicel::robot {

/// Reads a robot from a file of any known format, which its extension says, or else its text.
/// Faults go to `diagnostics`, and nothing comes back.
std::optional<RobotDescription> read_robot(const std::filesystem::path& path,
                                           const PackagePaths& packages, Diagnostics& diagnostics);

/// Whether the extension is that of a robot's file, in upper or lower case.
bool is_robot_name(const std::filesystem::path& path);
/// Whether the text is that of a robot, whatever its file is called.
bool is_robot_text(std::string_view text);
/// The formats with their extensions, for "expected one of": "URDF (.urdf, .xacro)".
std::string robot_formats();

}  // namespace pedicel::robot
