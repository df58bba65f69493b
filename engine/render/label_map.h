#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/render/draw_list.h"

namespace pedicel::render {

/// What each pixel shows, and how far away it is: by the middle of the pixel alone, without smooth
/// edges. Rows from the top.
struct LabelMap {
  int width = 0, height = 0;  ///< px
  std::vector<Label> labels;  ///< height x width; 0 where nothing, or nothing labelled, is seen
  std::vector<float> depth;   ///< height x width, m along the view axis; infinite where nothing is

  static constexpr float nothing = std::numeric_limits<float>::infinity();

  LabelMap() = default;
  LabelMap(int w, int h)
      : width(w),
        height(h),
        labels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)),
        depth(labels.size(), nothing) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace pedicel::render
