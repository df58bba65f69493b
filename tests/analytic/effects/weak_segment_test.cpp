// weak_segment: over a stretch the compliance is that of the factor, wherever the stretch lies and
// whichever way the curve is drawn. Compliances of joints add up in series, and the joint at a
// clamp stands for half a segment.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "plugins/plant/plant_builder.h"

namespace pedicel::plant {
namespace {

constexpr double stem_length = 0.4;  // m, of the stem

BuiltPlant built(const std::string& points, const std::string& effects) {
  Diagnostics diagnostics;
  const auto file = parse_plant(
      "format: pedicel-plant\nversion: 1\nname: p\nshape: drawn\n"
      "material: {youngs_modulus: 1.0e+8, poisson_ratio: 0.3, density: 700, damping_time: 0.01}\n"
      "sampling: {connect: 0.01, distance: 0.02}\nroot: [0, 0, 0]\ncurves:\n"
      "  - {name: stem, points: " +
          points + ", radius: 0.003}\n" + effects,
      "p.plant.yaml", diagnostics);
  EXPECT_TRUE(file) << diagnostics.text();
  auto plant = file ? build_plant(*file, {}, diagnostics) : std::nullopt;
  EXPECT_TRUE(plant) << diagnostics.text();
  return plant.value_or(BuiltPlant());
}

// m, of the stretch that would add what all joints have more of, each at the factor.
double weak_length(const std::string& points, double at, double stretch, double factor) {
  const BuiltPlant plain = built(points, "");
  const BuiltPlant weak =
      built(points, "effects:\n  - {name: weak_segment, factor: " + std::to_string(factor) +
                        ", length: " + std::to_string(stretch) +
                        ", where: {curve: stem, at: " + std::to_string(at) + "}}\n");
  double sum = 0.0;
  for (int e = 0; e < plain.model.size(); ++e) {
    const cosserat::Element& before = plain.model.elements[e];
    const double stands_for = before.parent < 0 ? 0.5 * before.length : before.length;
    const double more = before.bend_stiffness.x() / weak.model.elements[e].bend_stiffness.x() - 1.0;
    sum += more * stands_for;
  }
  return sum / (1.0 / factor - 1.0);
}

const std::string upward = "[[0, 0, 0], [0, 0, 0.4]]", downward = "[[0, 0, 0.4], [0, 0, 0]]";

TEST(WeakSegment, InTheMiddleAddsItsLength) {
  EXPECT_NEAR(weak_length(upward, 0.5, 0.1, 0.5), 0.1, 1e-9);
  EXPECT_NEAR(weak_length(downward, 0.5, 0.1, 0.5), 0.1, 1e-9);
  EXPECT_NEAR(weak_length(upward, 0.3, 0.033, 0.2), 0.033, 1e-9);
}

TEST(WeakSegment, AtTheClampAddsItsLengthToo) {
  EXPECT_NEAR(weak_length(upward, 0.05 / stem_length, 0.1, 0.5), 0.1, 1e-9);
  EXPECT_NEAR(weak_length(downward, 1.0 - 0.05 / stem_length, 0.1, 0.5), 0.1, 1e-9);
}

}  // namespace
}  // namespace pedicel::plant
