#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/render/label_map.h"

namespace pedicel::app {

/// The pixels of one label, as COCO has them: numbers of pixels in a row that are not in it, that
/// are, that are not, ..., down the columns from the upper left corner. The first may be 0.
struct RunLength {
  std::vector<std::uint32_t> counts;
  long area = 0;                       ///< px
  std::array<int, 4> box{0, 0, 0, 0};  ///< x, y, width, height, px
};

/// Of every label up to `most`, by label.
std::vector<RunLength> run_lengths(const render::LabelMap& map, std::size_t labels);

}  // namespace pedicel::app
