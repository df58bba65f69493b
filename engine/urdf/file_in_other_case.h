#pragma once

#include <filesystem>
#include <optional>

namespace pedicel::robot {

/// The one file whose path differs from `path` in upper and lower case only. Nothing where there is
/// none, or more than one.
std::optional<std::filesystem::path> file_in_other_case(const std::filesystem::path& path);

}  // namespace pedicel::robot
