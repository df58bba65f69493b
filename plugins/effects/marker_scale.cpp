#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A measuring scale that is off, about the world's origin.
EffectDefinition define_marker_scale() {
  EffectDefinition d;
  d.name = "marker_scale";
  d.plain_name = "a measuring scale that is off";
  d.sentence = "the scale of the markers is off";
  d.file = EffectFile::experiment;
  d.home = Home::sensor;
  d.family = Family::frame;
  d.parameters = {{.name = "factor",
                   .bounds = io::positive,
                   .sentence = "marker places are multiplied, about the world's origin",
                   .vanishes = Vanishes::at_one,
                   .first = {1.0}}};
  d.change = SensorChange{[](const plant::Effect& effect, SensorState& sensor) {
    // About the world's origin, as a camera's calibration scales all that it sees. With frames that
    // are turned it goes in any order.
    sensor.frame *= effect.number("factor");
  }};
  d.starts = [](const StartContext&) -> std::vector<Start> {
    // A plant bends and hardly stretches, so lengths between markers tell a scale to a fraction of
    // a per cent.
    return {Start("marker_scale").positive("factor", 1.001, 0.3, 3.0)};
  };
  // In per cent of the model's lengths.
  d.speaks_for = {{"length_scale", 1, "factor",
                   [](double percent, const StartContext&) { return 1.0 + 0.01 * percent; }}};
  // The plant itself cannot: a smaller plant with another modulus swings alike.
  d.tells_apart = "measure the distance of two markers with a ruler";
  return d;
}

}  // namespace pedicel::effects
