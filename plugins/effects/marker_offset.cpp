#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A marker that sits elsewhere than stated; the offset turns with its element.
EffectDefinition define_marker_offset() {
  EffectDefinition d;
  d.name = "marker_offset";
  d.plain_name = "a marker that sits elsewhere";
  // One marker: what is wrong with all of them alike is a frame or a scale.
  d.sentence = "a marker sits aside of where it is said to be";
  d.file = EffectFile::experiment;
  d.home = Home::sensor;
  d.family = Family::frame;
  d.parameters = {
      {.name = "marker", .sentence = "which one sits aside", .size = 0, .role = Role::shape},
      {.name = "offset",
       .unit = "m",
       .sentence = "by how much",
       .size = 3,
       .vanishes = Vanishes::at_zero,
       .first = {0.0, 0.0, 1.0}}};
  d.change = SensorChange{[](const plant::Effect& effect, SensorState& sensor) {
    // Added and not set: offsets of one marker add up, as those of one instrument do.
    // In the element's axes: what is glued on turns with the stem. That is how it differs from a
    // frame that is off.
    for (std::size_t m = 0; m < sensor.markers.size(); ++m)
      if (sensor.markers[m] == effect.words.at("marker"))
        sensor.offset[m] += Vec3(effect.numbers.at("offset").data());
  }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // Each marker is a start of its own, since a word cannot be moved by a fit. Three axes, because
    // a direction of the score test is one.
    for (int axis = 0; axis < 3; ++axis)
      for (const std::string& marker : c.markers)
        starts.push_back(Start("marker_offset")
                             .word("marker", marker)
                             // A tenth of a millimetre, so that the direction is linear; a free
                             // vector, so that the fit finds the way.
                             .vector("offset", 1e-4 * Vec3::Unit(axis), 1e-3, 0.2));
    return starts;
  };
  d.speaks_for = {
      {"bad_channel", 1}, {"constant_offset", 1}, {"length_scale", 2}, {"excess_curvature", 4}};
  d.tells_apart = "measure the marker's place with a ruler";
  return d;
}

}  // namespace pedicel::effects
