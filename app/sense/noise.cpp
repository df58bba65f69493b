#include "app/sense/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::app {

namespace {

std::uint8_t byte_of(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l));
}

void add_to_colours(render::Image& image, const world::CameraNoise& noise, Random& random) {
  const double gain = 1.0 + noise.gain_std * (noise.gain_std > 0.0 ? random.normal() : 0.0);
  const double deviation = 255.0 * noise.rgb_std;
  for (std::uint8_t& value : image.rgb)
    value = byte_of(gain * value + (deviation > 0.0 ? deviation * random.normal() : 0.0));
}

/// Whether a depth leaves the plane of its neighbours to either side by more than `edge` (m). The
/// inverse depth of a plane is linear over the picture, so that a floor far away has no edges.
bool at_edge(const render::LabelMap& map, const std::vector<float>& depth, int x, int y,
             double edge) {
  const double own = depth[map.index(x, y)];
  const auto leaves = [&](std::size_t before, std::size_t after) {
    const double bend = 1.0 / depth[before] + 1.0 / depth[after] - 2.0 / own;
    return std::abs(bend) * own * own > edge;
  };
  return (x > 0 && x + 1 < map.width && leaves(map.index(x - 1, y), map.index(x + 1, y))) ||
         (y > 0 && y + 1 < map.height && leaves(map.index(x, y - 1), map.index(x, y + 1)));
}

void add_to_depths(render::LabelMap& map, const world::CameraNoise& noise, Random& random) {
  const std::vector<float> exact = map.depth;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      float& depth = map.depth[map.index(x, y)];
      if (!std::isfinite(depth)) continue;
      if (noise.dropout > 0.0 && at_edge(map, exact, x, y, noise.edge) &&
          random.uniform() < noise.dropout) {
        depth = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      if (noise.depth_std > 0.0)
        depth += static_cast<float>(noise.depth_std * depth * depth * random.normal());
    }
}

}  // namespace

std::uint64_t noise_seed(std::uint64_t run_seed, std::string_view sensor, std::uint64_t sample) {
  std::uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  const auto mix = [&hash](std::uint64_t byte) { hash = (hash ^ byte) * 0x100000001b3ull; };
  for (const char c : sensor) mix(static_cast<unsigned char>(c));
  for (const std::uint64_t value : {run_seed, sample})
    for (int shift = 0; shift < 64; shift += 8) mix((value >> shift) & 255u);
  return hash;
}

void add_noise(SensedPicture& picture, const world::CameraNoise& noise, Random random) {
  if (noise.gain_std > 0.0 || noise.rgb_std > 0.0) add_to_colours(picture.image, noise, random);
  if (noise.depth_std > 0.0 || noise.dropout > 0.0) add_to_depths(picture.map, noise, random);
}

}  // namespace pedicel::app
