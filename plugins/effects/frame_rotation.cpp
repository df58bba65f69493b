#include "plugins/cosserat/model/rotation.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A measuring frame that is turned about the world's origin.
EffectDefinition define_frame_rotation() {
  EffectDefinition d;
  d.name = "frame_rotation";
  d.plain_name = "a measuring frame that is turned";
  d.sentence = "the frame of the markers is turned";
  d.file = EffectFile::experiment;
  // After the simulation: the plant stands as it does, and only its markers are seen turned. A
  // plant that stands turned hangs otherwise, too, and that tells the two apart.
  d.home = Home::sensor;
  d.family = Family::frame;
  d.parameters = {{.name = "rotation",
                   .unit = "rad",
                   .sentence = "markers are turned about the world's origin",
                   // A rotation vector: its length is the angle.
                   .size = 3,
                   .vanishes = Vanishes::at_zero,
                   .first = {0.0, 0.0, 1.0}}};
  d.change = SensorChange{[](const plant::Effect& effect, SensorState& sensor) {
    const Vec3 rotation(effect.numbers.at("rotation").data());
    // From the left: a later effect turns what an earlier one has made, scale included.
    sensor.frame = cosserat::exp_map(rotation).toRotationMatrix() * sensor.frame;
  }};
  d.starts = [](const StartContext&) {
    std::vector<Start> starts;
    // About each axis by a tenth of a milliradian, as a direction for the score tests. It is small,
    // so that the response is linear.
    // A vector of three, free in all: 0.7 rad keep away from the half turn, where a rotation vector
    // jumps.
    for (int axis = 0; axis < 3; ++axis)
      starts.push_back(
          Start("frame_rotation").vector("rotation", 1e-4 * Vec3::Unit(axis), 0.01, 0.7));
    return starts;
  };
  d.speaks_for = {
      {"base_rotation", 2}, {"constant_offset", 3}, {"out_of_plane", 4}, {"plant_shift", 2}};
  d.tells_apart = "record the unloaded plant with a plumb line in view";
  return d;
}

}  // namespace pedicel::effects
