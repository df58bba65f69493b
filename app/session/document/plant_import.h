#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/diagnostics.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::app {

bool is_plant_file(const std::filesystem::path& path);

/// A plant file or a skeleton (see plant::source_kind()), by its name. `unit` (m) is that of a
/// skeleton's lengths; 0: as the file says. Faults go to `diagnostics`, and then
/// nothing comes back; so do warnings and the plant's height.
std::optional<plant::PlantFile> read_plant(const std::filesystem::path& path,
                                           Diagnostics& diagnostics, double unit = 0.0);

/// Metres a unit that a user names ("cm", "0.01"); 0 for an empty text. Throws UsageError, which
/// names `option`.
double unit_of_text(const std::string& text, const std::string& option);

}  // namespace pedicel::app
