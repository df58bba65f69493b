#include <algorithm>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// An instrument that follows what it measures with a first-order lag.
EffectDefinition define_sensor_lag() {
  EffectDefinition d;
  d.name = "sensor_lag";
  d.plain_name = "an instrument that follows with a lag";
  d.sentence = "what an instrument reports follows with a first-order lag: y' = (x - y) / time";
  d.file = EffectFile::experiment;
  d.home = Home::sensor;
  d.parameters = {{.name = "time",
                   .unit = "s",
                   .bounds = io::not_negative,
                   // To first order in the lags they do: two filters in a row delay by the sum of
                   // their times.
                   .sentence = "time constant; those of one instrument add up",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.02}},
                  {.name = "what",
                   .sentence = "which instrument lags",
                   .size = 0,
                   // A word and no two effects: it is one law, and either instrument may have it.
                   .words = {"force", "markers"},
                   .role = Role::shape}};
  // At rest at time 0: a filter that has watched a plant at rest has caught up with it.
  d.change = SensorChange{[](const plant::Effect& effect, SensorState& sensor) {
    const bool force = effect.words.at("what") == "force";
    // One number for each instrument: the filter runs once, with the sum.
    (force ? sensor.force_lag : sensor.marker_lag) += effect.number("time");
  }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    const auto add = [&](const char* what) {
      // In samples, since a lag far below one is not seen.
      const double time = std::max(c.scales.sample_time, 1.0e-3);
      starts.push_back(
          Start("sensor_lag").word("what", what).positive("time", 2.0 * time, 0.02 * time, 1.0));
    };
    // Only what was measured can lag.
    if (c.force) add("force");
    // Markers are in every experiment.
    add("markers");
    return starts;
  };
  // Of what changes slowly beside its time a lag makes a delay of that time.
  constexpr auto seconds = [](double ms, const StartContext&) { return 1.0e-3 * ms; };
  d.speaks_for = {{"time_shift", 2, "time", seconds, "markers"},
                  {"force_lag", 1, "time", seconds, "force"},
                  {"delay_by_frequency", 1}};
  // A delay keeps the size of what it shows. A filter of first order makes it smaller by 1 / sqrt(1
  // + (w time)^2).
  d.tells_apart =
      "shake at two frequencies: a lag makes the faster motion smaller, a delay only makes it late";
  return d;
}

}  // namespace pedicel::effects
