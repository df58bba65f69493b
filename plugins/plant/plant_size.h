#pragma once

#include <string>

#include "engine/core/diagnostics.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::plant {

/// How large a drawn plant is, m.
struct PlantSize {
  double height = 0.0;                    ///< from its lowest point to its highest
  double extent = 0.0;                    ///< the largest of height, width and depth
  double thinnest = 0.0, thickest = 0.0;  ///< diameters of its stems
};
PlantSize size_of(const PlantFile& plant);

/// "4.31 m tall, 812 nodes", for whoever loads it.
std::string size_text(const PlantFile& plant, std::size_t nodes);

/// " (it is 20 m tall and at most 4 mm thick: is its unit right?)" where a plant is so slender that
/// it may be; else empty.
std::string size_doubt(const PlantFile& plant);

/// Warns of a plant whose size none has: smaller than its thinnest stem is thick, or above 100 m.
/// Its unit is likely another one.
void warn_of_size(const PlantFile& plant, Diagnostics& diagnostics);

}  // namespace pedicel::plant
