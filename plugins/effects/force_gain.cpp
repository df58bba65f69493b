#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A force sensor that is off: gain and offset.
EffectDefinition define_force_gain() {
  EffectDefinition d;
  d.name = "force_gain";
  d.plain_name = "a force sensor that is off";
  d.sentence = "the force sensor is off: measured force = gain F + offset";
  d.file = EffectFile::experiment;
  d.home = Home::sensor;
  // With the grip, which makes forces at the hand wrong as well: beside one of the two the other
  // must bring much.
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
                   // The offset may go by itself, as a sensor may have a wrong gain alone.
                   .vanishes = Vanishes::at_zero,
                   .first = {0.0, 0.0, 0.0}}};
  d.change = SensorChange{[](const plant::Effect& effect, SensorState& sensor) {
    const double gain = effect.number("gain");
    // Several of them act one after the other, and the later one sees what the earlier one says,
    // its offset included.
    sensor.gain *= gain;
    sensor.force_offset *= gain;
    if (effect.numbers.contains("offset"))
      sensor.force_offset += Vec3(effect.numbers.at("offset").data());
  }};
  d.starts = [](const StartContext& c) -> std::vector<Start> {
    // Without a force the effect would be a cause that nothing speaks against.
    if (!c.force) return {};
    return {Start("force_gain")
                // A little off 1, where the effect would do nothing. A sensor that reads backwards
                // has no logarithm: admission looks for that in the data, before any fit.
                .positive("gain", 1.01, 0.1, 10.0)
                // Gain and zero are wrong together as a rule, and a fit of the one alone would take
                // up the other. Evidence gives the offset its price back where it is not needed.
                .vector("offset", Vec3::Zero(), 0.01, 100.0)};
  };
  // In per cent of the model's force.
  d.speaks_for = {{"force_scale", 1, "gain",
                   [](double percent, const StartContext&) { return 1.0 + 0.01 * percent; }}};
  d.tells_apart = "hang a known mass on the force sensor";
  return d;
}

}  // namespace pedicel::effects
