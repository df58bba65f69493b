#include "app/sense/point_cloud.h"

#include <cmath>
#include <cstring>

namespace pedicel::app {

PointCloud point_cloud_of(const SensedPicture& picture) {
  PointCloud cloud;
  const render::LabelMap& map = picture.map;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = map.index(x, y);
      if (!std::isfinite(map.depth[i])) continue;
      const Vec3 p = picture.camera.unproject(x + 0.5, y + 0.5, map.depth[i]);
      for (int axis = 0; axis < 3; ++axis) cloud.positions.push_back(static_cast<float>(p[axis]));
      if (!picture.image.rgb.empty()) {
        const std::uint8_t* colour = picture.image.at(x, y);
        cloud.colours.insert(cloud.colours.end(), colour, colour + 3);
      }
      cloud.labels.push_back(map.labels[i]);
    }
  return cloud;
}

std::string to_ply(const PointCloud& cloud) {
  const bool coloured = !cloud.colours.empty();
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string(cloud.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  if (coloured) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "property uint label\nend_header\n";
  const auto put = [&](const void* data, std::size_t size) {
    text.append(static_cast<const char*>(data), size);
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    put(&cloud.positions[3 * i], 3 * sizeof(float));
    if (coloured) put(&cloud.colours[3 * i], 3);
    put(&cloud.labels[i], sizeof(render::Label));
  }
  return text;
}

}  // namespace pedicel::app
