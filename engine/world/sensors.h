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

/// A vector that an instrument says.
struct InstrumentVector {
  std::string name, unit;              ///< "force", "N"
  std::array<std::string, 3> columns;  ///< "fx", "fy", "fz"
};

/// A kind of instrument on a robot or a plant. Scene files, `--set`, logs, topics, Python and the
/// manual walk instrument_kinds().
struct InstrumentKind {
  std::string name;     ///< "wrench": of its class, files, topics and columns
  std::string section;  ///< "wrenches": its list in a scene file, and in Python
  std::string what;     ///< "a wrench": in errors
  std::string noun;     ///< "force sensor"
  std::string says;     ///< what its numbers are, for Python
  /// Keys beside name, rate and noise. With `organ` there is `at`, with `position` `orientation`.
  std::vector<std::string> keys;
  std::vector<InstrumentVector> vectors;
};
const std::vector<InstrumentKind>& instrument_kinds();
/// That must be one.
const InstrumentKind& instrument_kind(std::string_view name);

/// What a real instrument adds. Each of its numbers has a noise of its own.
struct InstrumentNoise {
  struct Size {
    double std = 0.0;   ///< of each sample
    double bias = 0.0;  ///< of a constant
    double walk = 0.0;  ///< of a random walk after 1 s
  };
  explicit InstrumentNoise(const InstrumentKind& of) : kind(&of), sizes(of.vectors.size()) {}

  const InstrumentKind* kind;
  std::vector<Size> sizes;  ///< one a vector, in its unit
  double latency = 0.0;     ///< s

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
