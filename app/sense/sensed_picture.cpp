#include "app/sense/sensed_picture.h"

#include <cmath>

#include "engine/core/check.h"

namespace pedicel::app {

render::GrayImage instance_mask(const render::LabelMap& map) {
  render::GrayImage mask(map.width, map.height);
  for (std::size_t i = 0; i < map.labels.size(); ++i) {
    if (map.labels[i] > 65535)
      throw UsageError("label " + std::to_string(map.labels[i]) +
                       ": masks hold at most 65535 things");
    mask.values[i] = static_cast<std::uint16_t>(map.labels[i]);
  }
  return mask;
}

render::GrayImage class_mask(const render::LabelMap& map, const NamedThings& things) {
  render::GrayImage mask(map.width, map.height);
  for (std::size_t i = 0; i < map.labels.size(); ++i)
    mask.values[i] = static_cast<std::uint16_t>(things.of(map.labels[i]).kind);
  return mask;
}

render::GrayImage depth_millimetres(const std::vector<float>& depth, int width, int height) {
  render::GrayImage picture(width, height);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double mm = std::round(1000.0 * static_cast<double>(depth[i]));
    if (mm >= 1.0 && mm <= 65535.0) picture.values[i] = static_cast<std::uint16_t>(mm);
  }
  return picture;
}

}  // namespace pedicel::app
