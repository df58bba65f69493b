#pragma once

#include <filesystem>

#include "plugins/plant/plant_file.h"

namespace pedicel::app {

/// Writes a plant as it is drawn, by the name's end: *.plant.yaml, *.csv (skeleton), *.obj or
/// *.ply. Throws UsageError for another ending and io::WriteError.
void write_plant_as(const std::filesystem::path& path, const plant::PlantFile& plant);

}  // namespace pedicel::app
