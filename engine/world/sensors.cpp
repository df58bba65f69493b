#include "engine/world/sensors.h"

#include <algorithm>

namespace pedicel::world {

std::vector<Parameter> CameraNoise::parameters() {
  return {
      {"gain_std", "1", &gain_std, 0.0, 1.0,
       "Standard deviation of a factor on all of a picture; 0.02 for an automatic exposure."},
      {"rgb_std", "1", &rgb_std, 0.0, 1.0,
       "Standard deviation of each colour of each pixel, of full scale; 0.01 indoors."},
      {"depth_std", "m", &depth_std, 0.0, 1.0,
       "Standard deviation of a depth of 1 m; it grows with the square of the distance. 0.002 for "
       "a stereo camera."},
      {"dropout", "1", &dropout, 0.0, 1.0, "Share of pixels at edges that have no depth."},
      {"edge", "m", &edge, 0.0, 100.0,
       "An edge is where the depth leaves the plane of its neighbours by more than this."},
      {"latency", "s", &latency, 0.0, 10.0, "Delay of what the sensor says."}};
}

const std::vector<InstrumentKind>& instrument_kinds() {
  static const std::vector<InstrumentKind> kinds = {
      {"wrench",
       "wrenches",
       "a wrench",
       "force sensor",
       "force (N) and moment (N m) in the link's frame",
       {"link", "touch", "tared"},
       {{"force", "N", {"fx", "fy", "fz"}}, {"moment", "N m", {"tx", "ty", "tz"}}}},
      {"imu",
       "imus",
       "an IMU",
       "IMU",
       "acceleration less gravity (m/s2) and angular velocity (rad/s) in its own frame",
       {"link", "organ", "position"},
       {{"acceleration", "m/s2", {"ax", "ay", "az"}}, {"rate", "rad/s", {"wx", "wy", "wz"}}}}};
  return kinds;
}

const InstrumentKind& instrument_kind(std::string_view name) {
  return *std::ranges::find(instrument_kinds(), name, &InstrumentKind::name);
}

std::vector<Parameter> InstrumentNoise::parameters() {
  std::vector<Parameter> all;
  const auto add = [&](const char* word, double Size::*size, const std::string& sentence,
                       bool of_vector) {
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      const InstrumentVector& one = kind->vectors[v];
      all.push_back({one.name + word, one.unit, &(sizes[v].*size), 0.0, 1.0e3,
                     "Standard deviation of " + sentence + (of_vector ? one.name + "." : "")});
    }
  };
  add("_std", &Size::std, "each sample's ", true);
  add("_bias", &Size::bias, "a constant that is drawn once.", false);
  add("_walk", &Size::walk, "a random walk after 1 s.", false);
  all.push_back({"latency", "s", &latency, 0.0, 10.0, "Delay of what the sensor says."});
  return all;
}

std::string_view name_of(Sensor sensor) {
  constexpr std::array<std::string_view, sensor_count> names = {"rgb",     "depth",     "instances",
                                                                "classes", "keypoints", "points"};
  return names[static_cast<std::size_t>(sensor)];
}

std::vector<Parameter> SceneLook::parameters() {
  const auto hue = [](const char* name, double* value, const char* sentence) {
    return Parameter{name, "rad", value, -3.2, 3.2, sentence};
  };
  const auto factor = [](const char* name, double* value, const char* sentence) {
    return Parameter{name, "1", value, 0.0, 4.0, sentence};
  };
  return {factor("sun", &sun, "Strength of the sun."),
          {"azimuth", "rad", &azimuth, -6.3, 6.3, "Where the sun stands: about Z, 0 is X."},
          {"elevation", "rad", &elevation, 0.02, 1.58, "How high the sun stands."},
          {"exposure", "1", &exposure, 0.01, 100.0, "Factor on all light."},
          hue("stem_hue", &stem_hue, "Turns the hue of stems."),
          hue("leaf_hue", &leaf_hue, "Turns the hue of leaves."),
          hue("fruit_hue", &fruit_hue, "Turns the hue of fruits."),
          factor("stem_value", &stem_value, "Factor on the brightness of stems."),
          factor("leaf_value", &leaf_value, "Factor on the brightness of leaves."),
          factor("fruit_value", &fruit_value, "Factor on the brightness of fruits.")};
}

}  // namespace pedicel::world
