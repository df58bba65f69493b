#pragma once

#include "plugins/plant/plant_file.h"

namespace pedicel::simulation {

/// A line on standard error before a plant is built that takes long: whoever waits should know what
/// for. Nothing of a plant of the usual size.
void say_if_large(const plant::PlantFile& file);

}  // namespace pedicel::simulation
