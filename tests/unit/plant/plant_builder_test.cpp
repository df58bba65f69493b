// From curves to rods: what stands at a joint, where a place on a curve is
// found again, and the plants on which the peers were measured.
#include "plugins/plant/plant_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/cosserat/model/rod_state.h"
#include "plugins/plant/reference_plants.h"

namespace pedicel::plant {
namespace {

const std::string head =
    "format: pedicel-plant\nversion: 1\nname: p\nshape: rest\n"
    "material: {youngs_modulus: 1e8, poisson_ratio: 0.3, density: 700, "
    "damping_time: 0}\n"
    "sampling: {connect: 0.01, distance: 0.02}\nroot: [0, 0, 0]\ncurves:\n";
const std::string stem =
    "  - {name: stem, interpolation: linear, points: [[0, "
    "0, 0], [0, 0, 0.113]], radius: 0.004}\n";

BuiltPlant built(const std::string& text) {
  Diagnostics diagnostics;
  const auto plant = parse_plant(text, "p.plant.yaml", diagnostics);
  EXPECT_TRUE(plant) << diagnostics.text();
  auto result = build_plant(plant.value_or(PlantFile{}), {}, diagnostics);
  EXPECT_TRUE(result) << diagnostics.text();
  return result.value_or(BuiltPlant{});
}

Vec3 drawn_place(const BuiltPlant& plant, int curve, double at) {
  const PlacedPoint place = plant.locate(curve, at);
  const auto& element = plant.model.elements[place.element];
  const double share = place.back / element.length;
  return (1.0 - share) * element.drawn_position + share * plant.model.drawn_start(place.element);
}

TEST(PlantBuilder, FindsPlacesBetweenNodes) {
  const BuiltPlant plant = built(head + stem);
  for (const double at : {0.0, 0.1234, 0.5, 0.777, 1.0})
    EXPECT_LT((drawn_place(plant, 0, at) - Vec3(0, 0, 0.113 * at)).norm(), 1e-12) << at;
}

// A curve that goes on from another's end starts at that end: each element has
// one curve's section, and the fractions of both curves end at the joint. (With
// the joint no key node, the tip of the stem was found up to `distance` too
// low.)
TEST(PlantBuilder, KeepsTheJointOfCurvesEndToEnd) {
  const BuiltPlant plant = built(head + stem +
                                 "  - {name: upper, interpolation: linear, points: [[0, 0, 0.113], "
                                 "[0.05, 0, 0.15]], radius: "
                                 "0.001}\n");
  EXPECT_LT((drawn_place(plant, 0, 1.0) - Vec3(0, 0, 0.113)).norm(), 1e-12);
  EXPECT_LT((drawn_place(plant, 1, 0.0) - Vec3(0, 0, 0.113)).norm(), 1e-12);
  for (const auto& element : plant.model.elements)
    EXPECT_EQ(element.radius_far, element.organ == 0 ? 0.004 : 0.001);
  EXPECT_NEAR(plant.length_kept, plant.length_drawn, 1e-12);
}

TEST(PlantBuilder, TakesACurveDrawnFromTipToBase) {
  const BuiltPlant plant =
      built(head + stem +
            "  - {name: twig, interpolation: linear, points: [[0.1, 0, 0.113], "
            "[0, 0, 0.113]], radius: "
            "0.001}\n");
  EXPECT_LT((drawn_place(plant, 1, 0.0) - Vec3(0.1, 0, 0.113)).norm(), 1e-12);
  EXPECT_LT((drawn_place(plant, 1, 0.25) - Vec3(0.075, 0, 0.113)).norm(), 1e-12);
}

// The counts of peers.md.
std::string refusal(const std::string& text) {
  Diagnostics diagnostics;
  const auto plant = parse_plant(text, "p.plant.yaml", diagnostics);
  EXPECT_TRUE(plant) << diagnostics.text();
  EXPECT_FALSE(build_plant(plant.value_or(PlantFile{}), {}, diagnostics));
  return diagnostics.text();
}

std::string with_sampling(std::string text, const std::string& sampling) {
  const std::string usual = "{connect: 0.01, distance: 0.02}";
  return text.replace(text.find(usual), usual.size(), sampling);
}

// Nodes and samples are counted before any is made: these would take all memory.
TEST(PlantBuilder, CountsBeforeItMakes) {
  EXPECT_THAT(
      refusal(head + "  - {name: stem, points: [[0, 0, 0], [0, 0, 4000000]], radius: 1}\n"),
      testing::HasSubstr("p.plant.yaml:9:5: error: curve \"stem\" would take 2e+08 nodes at "
                         "sampling.distance 0.02 m (it is 4e+06 m long): expected at most "
                         "250000 nodes in a plant"));
  EXPECT_THAT(refusal(with_sampling(head + stem, "{connect: 0.01, distance: 1e-9}")),
              testing::HasSubstr("would take 1.1e+08 nodes at sampling.distance 1e-09 m"));
  EXPECT_THAT(refusal(with_sampling(head + stem, "{connect: 1e-9, distance: 0.02}") +
                      "  - {name: other, points: [[0, 0, 0.113], [0, 0.1, 0.2]], radius: 0.001}\n"),
              testing::HasSubstr("plant \"p\" would be sampled at"));
}

TEST(ReferencePlants, HaveTheElementsOfThePeers) {
  EXPECT_EQ(forest_size * forest_plant(0).size(), 2242);
  EXPECT_EQ(hanging_tree().size(), 2242);
  EXPECT_EQ(cantilever(20).size(), 20);
  const cosserat::RodModel plant = forest_plant(8);
  EXPECT_LT((plant.root.position - Vec3(0.5, 0.5, 0)).norm(), 1e-12);
  EXPECT_NEAR(plant.elements[0].radius_far, 0.005, 1e-12);
  EXPECT_NEAR(plant.elements[18].radius_far, 0.004, 1e-12);
}

}  // namespace
}  // namespace pedicel::plant
