#include <cmath>
#include <numbers>

#include "pedicel/cosserat/model/turn_frame.h"
#include "pedicel/effects/registry/effect_definition.h"
#include "pedicel/io/yaml.h"

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
  d.parameters = {{.name = "ratio",
                   .bounds = io::positive,
                   .sentence = "stiffness towards the direction over that across it",
                   .vanishes = Vanishes::at_one,
                   .first = {0.5}},
                  {.name = "direction",
                   .sentence = "in the plant's frame",
                   .size = 3,
                   .role = Role::shape,
                   .first = {0.0, 0.0, 1.0}}};
  d.check = [](const io::YamlNode& node, const plant::Effect& effect) {
    if (effect.numbers.contains("direction") &&
        Vec3(effect.numbers.at("direction").data()).isZero(0.0))
      node.error("anisotropy has a direction of length 0, expected a direction [x, y, z]");
  };
  d.change = ModelChange{Stage::frames, [](ModelTarget& t) {
                           t.each_span([&](const plant::RodPlaces::Span& span) {
                             cosserat::make_anisotropic(t.model, span.element, t.number("ratio"),
                                                        t.vector("direction"));
                           });
                         }};
  d.starts = [](const StartContext&) {
    // Stiffer one way is softer across it only in a single straight stem: branches tell them apart.
    std::vector<Start> starts;
    for (int i = 0; i < 4; ++i)
      starts.push_back(Start("anisotropy")
                           .positive("ratio", 0.8, 0.05, 20.0)
                           .heading("direction", 0.25 * i * std::numbers::pi));
    return starts;
  };
  d.speaks_for = {{"out_of_plane", 1}};
  d.tells_apart = "pull in four directions";
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
