#include <cmath>
#include <numbers>

#include "engine/io/yaml.h"
#include "plugins/cosserat/model/turn_frame.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Bending that is softer about one axis than about the other. Frames are turned to the direction,
// before anything else is done.
EffectDefinition define_anisotropy() {
  EffectDefinition d;
  d.name = "anisotropy";
  d.plain_name = "bending that is softer in one direction than across it";
  d.sentence = "bending towards a direction is stiffer or softer than across it";
  d.home = Home::joint;
  d.family = Family::softness;
  // A ratio and no second modulus: bending across the direction stays as stiff as before, and the
  // baseline's modulus is what is on both.
  d.parameters = {{.name = "ratio",
                   .bounds = io::positive,
                   .sentence = "stiffness towards the direction over that across it",
                   .vanishes = Vanishes::at_one,
                   .first = {0.5}},
                  {.name = "direction",
                   .sentence = "in the plant's frame",
                   .size = 3,
                   // A shape and no size: no direction makes the effect vanish.
                   .role = Role::shape,
                   .first = {0.0, 0.0, 1.0}}};
  d.check = [](const io::YamlNode& node, const plant::Effect& effect) {
    // Only its direction counts, so a length of zero is the one thing that cannot be read.
    if (effect.numbers.contains("direction") &&
        Vec3(effect.numbers.at("direction").data()).isZero(0.0))
      node.error("anisotropy has a direction of length 0, expected a direction [x, y, z]");
  };
  // First of all stages: laws and constants are written in the axes of the frames, and would else
  // stand in axes that turn away below them.
  d.change = ModelChange{Stage::frames, [](ModelTarget& t) {
                           t.each_span([&](const plant::RodPlaces::Span& span) {
                             cosserat::make_anisotropic(t.model, span.element, t.number("ratio"),
                                                        t.vector("direction"));
                           });
                         }};
  d.starts = [](const StartContext&) {
    // Stiffer one way is softer across it only in a single straight stem: branches tell them apart.
    std::vector<Start> starts;
    // Every 45 degrees, half a turn in all: a direction and its opposite are the same.
    for (int i = 0; i < 4; ++i)
      starts.push_back(Start("anisotropy")
                           .positive("ratio", 0.8, 0.05, 20.0)
                           .heading("direction", 0.25 * i * std::numbers::pi));
    return starts;
  };
  // A push along one axis of an anisotropic stem sends it out of the plane of the push, and hardly
  // anything else does.
  d.speaks_for = {{"out_of_plane", 1}};
  d.tells_apart = "pull in four directions";
  // Stiffer towards a direction by r is softer across it by r, once the modulus is multiplied by r.
  // A ridge lies between the two, over which a fit may not climb, so the other one is offered as a
  // start. Only in a single straight stem do they do nearly the same.
  d.twin = [](const plant::Effect& effect, double& modulus) {
    plant::Effect twin = effect;
    const std::vector<double>& direction = effect.numbers.at("direction");
    const double across = std::atan2(direction[1], direction[0]) + 0.5 * std::numbers::pi;
    twin.numbers["direction"] = {std::cos(across), std::sin(across), 0.0};
    modulus = effect.number("ratio");
    twin.numbers["ratio"] = {1.0 / modulus};
    return twin;
  };
  return d;
}

}  // namespace pedicel::effects
