#pragma once

#include <vector>

#include "app/sense/sensed_picture.h"

namespace pedicel::app {

/// What a depth camera sees, as points of the world: one a pixel that has a depth, row by row.
struct PointCloud {
  std::vector<float> positions;       ///< points x 3, m, W
  std::vector<std::uint8_t> colours;  ///< points x 3, sRGB; empty where the picture has none
  std::vector<render::Label> labels;  ///< one a point

  std::size_t size() const { return labels.size(); }
};

PointCloud point_cloud_of(const SensedPicture& picture);

/// As a binary PLY file with x y z, red green blue (where there are colours) and label.
std::string to_ply(const PointCloud& cloud);

}  // namespace pedicel::app
