#pragma once

#include "engine/io/bounds.h"

/// What positions, extents and masses may be: beyond, numbers have too few digits for a contact or
/// a joint. Map coordinates lie within.
namespace pedicel::io {

inline constexpr Bounds place_bounds{-1e7, 1e7};        ///< m, a coordinate
inline constexpr Bounds extent_bounds{0.0, 1e7, true};  ///< m, a length, a radius
inline constexpr Bounds mass_bounds{0.0, 1e9};          ///< kg

}  // namespace pedicel::io
