#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/parameter.h"

namespace pedicel::world {

/// What a real camera adds to what it sees. All zero: nothing.
struct CameraNoise {
  double gain_std = 0.0;   ///< 1, of a factor on each picture
  double rgb_std = 0.0;    ///< 1, of full scale, of each colour of each pixel
  double depth_std = 0.0;  ///< m, at 1 m; grows with the square of the distance
  double dropout = 0.0;    ///< 1, share of pixels at edges that have no depth
  double edge = 0.02;      ///< m, step of the depth to a neighbour that makes an edge
  double latency = 0.0;    ///< s, that a picture comes after what it shows

  std::vector<Parameter> parameters();
};

/// What a real force sensor adds. Each of its six numbers has a noise of its own.
struct WrenchNoise {
  double force_std = 0.0, moment_std = 0.0;    ///< N, N m, of each sample
  double force_bias = 0.0, moment_bias = 0.0;  ///< N, N m, of a constant
  double force_walk = 0.0, moment_walk = 0.0;  ///< N, N m, of a random walk after 1 s
  double latency = 0.0;                        ///< s

  std::vector<Parameter> parameters();
};

/// What is written of a camera's pictures.
enum class Sensor { rgb, depth, instances, classes, keypoints, points };
inline constexpr int sensor_count = 6;
/// "rgb"
std::string_view name_of(Sensor sensor);

/// How a picture looks: the light, and how far the colours of plants are from their own.
struct SceneLook {
  double sun = 0.82;  ///< 1, strength
  double azimuth = -0.885,
         elevation = 0.875;  ///< rad, of the sun: about Z from X, above the horizon
  double exposure = 1.0;     ///< 1, factor on all light
  double stem_hue = 0.0, leaf_hue = 0.0, fruit_hue = 0.0;        ///< rad
  double stem_value = 1.0, leaf_value = 1.0, fruit_value = 1.0;  ///< 1, factors on brightness

  std::vector<Parameter> parameters();
  bool operator==(const SceneLook&) const = default;
};

}  // namespace pedicel::world
