#pragma once

#include "plugins/coupling/blade_source.h"

namespace pedicel::simulation {

/// A triangle of a leaf, its corners places on elements of a plant.
using BladeCorner = coupling::BladeCorner;
using Blade = coupling::BladeFace;

}  // namespace pedicel::simulation
