#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "engine/io/number_text.h"
#include "plugins/skeleton/stated_unit.h"
#include "plugins/skeleton/text_cells.h"

namespace pedicel::plant {

/// Where the features of an MTG's entities stand, and what a number in them is in metres.
struct MtgColumns {
  int codes = 0;  ///< columns that hold the entities
  /// XX, YY and ZZ (or X, Y and Z), or the same column three times: "(0.1, 0.2, 0.3)".
  std::array<int, 3> place = {-1, -1, -1};
  std::array<double, 3> scale = {0.001, 0.001, 0.001};
  int foot = -1;  ///< where a first entity begins, in one column, -1: nowhere
  int diameter = -1;
  double diameter_scale = 0.0001;
  std::vector<std::string> names;

  bool in_one() const { return place[0] >= 0 && place[0] == place[1]; }
};

/// From the line that begins with ENTITY-CODE (or TOPO, in AMAPmod's older files). What is missing
/// or contradicts goes to the diagnostics, and then `codes` is 0.
MtgColumns find_mtg_columns(const std::vector<TextCell>& cells, const StatedLengthUnit& unit,
                            const SourcePosition& line, Diagnostics& diagnostics);

/// The numbers of "Vector3(0.1,0.2,0.3)", "(0.1, 0.2, 0.3)" or "[0.1 0.2 0.3]"; nothing where there
/// are not just three.
std::optional<Vec3> place_in_one(std::string_view text, const io::NumberStyle& style);

}  // namespace pedicel::plant
