#pragma once

#include <span>
#include <string_view>

#include "engine/io/bounds.h"
#include "plugins/plant/model/plant_model.h"

namespace pedicel::plant {

/// A factor on the shape of a whole plant, as `--set` and `vary` take it: its one description. 1
/// leaves it as it is.
struct ShapeFactor {
  enum class What { radius, length, fruit, leaf };
  std::string_view key;  ///< "shape.radius"
  What what = What::radius;
  std::string_view sentence;
};
std::span<const ShapeFactor> shape_factors();
inline constexpr io::Bounds shape_bounds{0.05, 20.0};

/// Null where there is no such key.
const ShapeFactor* find_shape_factor(std::string_view key);

/// Lengths grow about the root, and with them how near curves must be to be joined and the spacing
/// of nodes: a plant keeps its segments, so that a simulation of it can begin anew with others.
void scale_shape(PlantFile& plant, ShapeFactor::What what, double factor);

}  // namespace pedicel::plant
