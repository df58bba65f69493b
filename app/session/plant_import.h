#pragma once

#include <filesystem>
#include <optional>

#include "core/diagnostics.h"
#include "plant/plant_file.h"

namespace pedicel::app {

bool is_plant_file(const std::filesystem::path& path);

/// A plant file, a skeleton table (*.csv) or an MTG (*.mtg), by its name. Faults go to
/// `diagnostics`, and then nothing comes back.
std::optional<plant::PlantFile> read_plant(const std::filesystem::path& path,
                                           Diagnostics& diagnostics);

}  // namespace pedicel::app
