// rest_shape: a straight curve whose own curvature is kappa(s) = curvature + gradient (s - L/2).
// Without load a segment points where the integral of kappa up to its middle says; joints in its
// middle sums of a linear kappa are exact.
#include <gtest/gtest.h>

#include <cmath>

#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/stem_plants.h"

namespace pedicel::plant {
namespace {

constexpr double length = 0.4;  // m, of the stem

struct Bent {
  BuiltPlant plant;
  cosserat::RodState state;

  Vec3 direction(int element) const { return state.orientation[element] * Vec3::UnitZ(); }
  double middle(int element) const {
    for (const RodPlaces::Span& span : plant.spans)
      if (span.element == element) return 0.5 * (span.arc_near + span.arc_far);
    return -1.0;
  }
};

// At rest without gravity.
Bent bent(const std::string& effect, const std::string& curves = straight_stem_text) {
  Diagnostics diagnostics;
  const auto file =
      parse_plant(curves + "effects:\n  - " + effect + "\n", "p.plant.yaml", diagnostics);
  EXPECT_TRUE(file) << diagnostics.text();
  auto built = file ? build_plant(*file, {}, diagnostics) : std::nullopt;
  EXPECT_TRUE(built) << diagnostics.text();
  Bent bent;
  if (!built) return bent;
  bent.plant = *built;
  bent.state = cosserat::drawn_state(bent.plant.model);
  // Of the way that it has to go its damping leaves 1e-5 the first time.
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(cosserat::settle(bent.plant.model, bent.state, Vec3::Zero()).errors, 0u);
  return bent;
}

// About y alone z goes to x: the angle at s is c s + g (s^2 - L s)/2.
TEST(RestShape, TurnsAsTheIntegralSays) {
  const Bent found = bent(
      "{name: rest_shape, curvature: [1.5, 0], gradient: [4, 0], normal: [0, 1, 0.5], "
      "where: {curve: stem}}");
  ASSERT_GT(found.plant.model.size(), 5);
  for (int e = 0; e < found.plant.model.size(); ++e) {
    const double s = found.middle(e), angle = 1.5 * s + 2.0 * (s * s - length * s);
    EXPECT_NEAR(std::atan2(found.direction(e).x(), found.direction(e).z()), angle, 1.0e-8) << e;
    EXPECT_NEAR(found.direction(e).y(), 0.0, 1.0e-9) << e;
  }
}

// e2 = tangent x e1 = z x y = -x, about which z goes to y.
TEST(RestShape, SecondAxisIsTangentTimesNormal) {
  const Bent found =
      bent("{name: rest_shape, curvature: [0, 1.2], gradient: [0, -3], normal: [0, 1, 0]}");
  for (int e = 0; e < found.plant.model.size(); ++e) {
    const double s = found.middle(e), angle = 1.2 * s - 1.5 * (s * s - length * s);
    EXPECT_NEAR(std::atan2(found.direction(e).y(), found.direction(e).z()), angle, 1.0e-8) << e;
  }
}

// Drawn from its tip to its root the same curve has the tangent -z: as s falls from L at the root,
// the stem turns by -kappa along its growth, and L - s takes the place of s.
TEST(RestShape, CountsAlongTheCurveAsDrawn) {
  std::string reversed = straight_stem_text;
  const std::string up = "[[0, 0, 0], [0, 0, 0.4]]", down = "[[0, 0, 0.4], [0, 0, 0]]";
  ASSERT_NE(reversed.find(up), std::string::npos);
  reversed.replace(reversed.find(up), up.size(), down);
  const Bent found = bent(
      "{name: rest_shape, curvature: [1.5, 0], gradient: [4, 0], normal: [0, 1, 0]}", reversed);
  for (int e = 0; e < found.plant.model.size(); ++e) {
    const double s = found.middle(e), from_root = length - s;
    // minus the integral of 1.5 + 4 (s - L/2) from s to L
    const double angle = -(1.5 * from_root + 2.0 * (length * length - s * s - length * from_root));
    EXPECT_NEAR(std::atan2(found.direction(e).x(), found.direction(e).z()), angle, 1.0e-8) << e;
  }
}

// A branch alone: the stem stays straight, and the branch begins to bend where it begins.
TEST(RestShape, OfOneBranch) {
  const std::string branch =
      "  - {name: branch, interpolation: linear, points: [[0, 0, 0.2], [0.2, 0, 0.2]],"
      " radius: 0.002}\n";
  const Bent found = bent(
      "{name: rest_shape, curvature: [2, 0], gradient: [0, 0], normal: [0, 0, 1], "
      "where: {curve: branch}}",
      straight_stem_text + branch);
  int of_branch = 0;
  for (const RodPlaces::Span& span : found.plant.spans) {
    const Vec3 along = found.direction(span.element);
    if (span.curve == 0) {
      EXPECT_NEAR(along.z(), 1.0, 1.0e-12);
      continue;
    }
    ++of_branch;
    EXPECT_NEAR(std::atan2(along.y(), along.x()), 2.0 * found.middle(span.element), 1.0e-8);
  }
  EXPECT_GT(of_branch, 3);
}

// It adds to the shape that undoes gravity: under gravity a drawn stem stands as drawn but for it.
TEST(RestShape, OfNoneChangesNothing) {
  const Bent found =
      bent("{name: rest_shape, curvature: [0, 0], gradient: [0, 0], normal: [0, 1, 0]}");
  Diagnostics diagnostics;
  const auto plain =
      build_plant(*parse_plant(straight_stem_text, "p.plant.yaml", diagnostics), {}, diagnostics);
  for (int e = 0; e < found.plant.model.size(); ++e)
    EXPECT_EQ(found.plant.model.elements[e].rest_rotation.coeffs(),
              plain->model.elements[e].rest_rotation.coeffs());
}

TEST(RestShape, RefusesWhatItCannotBe) {
  const auto says = [](const std::string& effect) {
    Diagnostics diagnostics;
    const auto file = parse_plant(straight_stem_text + "effects:\n  - " + effect + "\n",
                                  "p.plant.yaml", diagnostics);
    if (file) build_plant(*file, {}, diagnostics);
    return diagnostics.text();
  };
  EXPECT_NE(says("{name: rest_shape, curvature: [1], gradient: [0, 0], normal: [0, 1, 0]}")
                .find("curvature has 1 numbers, expected 2"),
            std::string::npos);
  EXPECT_NE(says("{name: rest_shape, curvature: [1, 0], gradient: [0, 0], normal: [0, 0, 0]}")
                .find("normal of length 0"),
            std::string::npos);
  EXPECT_NE(says("{name: rest_shape, curvature: [1, 0], gradient: [0, 0], normal: [0, 0, 2]}")
                .find("normal along the curve, expected one across it"),
            std::string::npos);
}

}  // namespace
}  // namespace pedicel::plant
