#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Markers that come late: their clock lags behind the drive.
EffectDefinition define_latency() {
  EffectDefinition d;
  d.name = "latency";
  d.plain_name = "markers that come late";
  d.sentence = "markers come late";
  d.file = EffectFile::experiment;
  d.home = Home::sensor;
  d.parameters = {{.name = "delay",
                   .unit = "s",
                   .sentence = "the markers come late by this",
                   .vanishes = Vanishes::at_zero,
                   // A time, and so known to a step at best.
                   .role = Role::time}};
  d.change = SensorChange{[](const plant::Effect& effect, SensorState& sensor) {
    // Of the markers alone. Drive and force are of the machine that moves the plant, and keep its
    // clock.
    sensor.delay += effect.number("delay");
  }};
  d.starts = [](const StartContext&) {
    std::vector<Start> starts;
    // Either sign: which of two clocks was started first is a matter of chance.
    // Within a second. Clocks that are farther apart are no late markers: admission checks them
    // before any fit.
    for (const double delay : {0.01, -0.01})
      starts.push_back(Start("latency").signed_number("delay", delay, 0.01, -1.0, 1.0));
    return starts;
  };
  // The first in ms, and the same number.
  d.speaks_for = {
      {"time_shift", 1, "delay", [](double ms, const StartContext&) { return 1.0e-3 * ms; }},
      {"robot_lag", 2}};
  // A tap has all frequencies: what is late is then seen without any model.
  d.tells_apart = "let the markers and the drive record one sharp tap";
  return d;
}

}  // namespace pedicel::effects
