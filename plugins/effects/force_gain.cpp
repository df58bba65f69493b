#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A force sensor that is off: gain and offset.
EffectDefinition define_force_gain() {
  EffectDefinition d;
  d.name = "force_gain";
  d.plain_name = "a force sensor that is off";
  d.sentence = "the force sensor is off: measured force = gain F + offset";
  d.file = EffectFile::experiment;
  d.home = Home::sensor;
  d.family = Family::grip;
  d.parameters = {{.name = "gain",
                   .sentence = "measured force = gain F + offset",
                   .vanishes = Vanishes::at_one},
                  {.name = "offset",
                   .unit = "N",
                   .sentence = "the same",
                   .size = 3,
                   .required = false,
                   .otherwise = "`[0, 0, 0]`",
                   .offered = false,
                   .vanishes = Vanishes::at_zero,
                   .first = {0.0, 0.0, 0.0}}};
  d.change = SensorChange{[](const plant::Effect& effect, SensorState& sensor) {
    const double gain = effect.number("gain");
    sensor.gain *= gain;
    sensor.force_offset *= gain;
    if (effect.numbers.contains("offset"))
      sensor.force_offset += Vec3(effect.numbers.at("offset").data());
  }};
  d.starts = [](const StartContext& c) -> std::vector<Start> {
    if (!c.force) return {};
    return {Start("force_gain")
                .positive("gain", 1.01, 0.1, 10.0)
                .vector("offset", Vec3::Zero(), 0.01, 100.0)};
  };
  d.speaks_for = {{"force_scale", 1}};
  d.tells_apart = "hang a known mass on the force sensor";
  return d;
}

}  // namespace pedicel::effects
