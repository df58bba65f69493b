// Causes that are the plant's own, in experiments of a robot at it.
#include "pedicel/discrepancy/scene_fit/plant_causes.h"

#include <gtest/gtest.h>

#include "diagnosed_scene.h"

namespace pedicel::discrepancy {
namespace {

/// A stem that is seen along all of its length, below the push, too.
class DiagnosedPlant : public DiagnosedScene {
 protected:
  DiagnosedPlant() {
    at_.instruments =
        "markers:\n"
        "  - {name: tip, curve: stem, at: 1}\n"
        "  - {name: middle, curve: stem, at: 0.6}\n"
        "  - {name: nail, link: finger, offset: [0, 0, 0.1]}\n"
        "  - {name: low, curve: stem, at: 0.15}\n"
        "  - {name: below, curve: stem, at: 0.3}\n"
        "wrenches:\n  - {name: wrist, link: finger}\n"
        "noise: {position_std: 0.0003, force_std: 0.03, moment_std: 0.002, joint_std: 0.00002}\n";
  }
  /// All markers are seen, no camera is there.
  void write_tables() {
    std::string markers = "time";
    for (const char* name : {"tip", "middle", "nail", "low", "below"})
      for (const char* axis : {".x", ".y", ".z"}) markers += std::string(",") + name + axis;
    markers += "\n";
    for (int i = 0; i <= 120; ++i)
      markers += std::to_string(0.01 * i) + std::string(15, ',') + "\n";
    more_ = {{"push/markers.csv", markers}};
  }
};

TEST_F(DiagnosedPlant, ARootThatTurnsIsNamedWithItsStiffness) {
  write_tables();
  // 4 times EI over the stem's length.
  const SceneDiagnosis found = diagnose({"{name: base_compliance, stiffness: 1.4}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  ASSERT_EQ(found.verdict.causes.size(), 1U) << found.text;
  const NamedCause* root = cause(found, "base_compliance");
  ASSERT_TRUE(root) << found.text;
  EXPECT_NEAR(root->parameters.at("stiffness")[0].value, 1.4, 0.15) << found.text;
}

TEST_F(DiagnosedPlant, AWeakStretchIsNamedWithItsPlace) {
  write_tables();
  const SceneDiagnosis found =
      diagnose({"{name: weak_segment, where: {curve: stem, at: 0.4}, factor: 0.35, length: 0.06}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  const NamedCause* weak = cause(found, "weak_segment");
  ASSERT_TRUE(weak) << found.text;
  ASSERT_TRUE(weak->where);
  EXPECT_EQ(weak->where->curve, "stem");
  EXPECT_NEAR(weak->where->at, 0.4, 0.08) << found.text;
}

TEST_F(DiagnosedPlant, WhatCouldHideIsSmallerThanWhatIsFound) {
  write_tables();
  const SceneDiagnosis found = diagnose({});
  ASSERT_EQ(found.verdict.outcome, Outcome::adequate) << found.text;
  const auto limit =
      std::ranges::find(found.verdict.detectable_limits, "wrench_bias", &DetectableLimit::name);
  ASSERT_NE(limit, found.verdict.detectable_limits.end());
  EXPECT_EQ(limit->unit, "N");
  // A force of 0.03 N of noise: a tenth of it shifts the mean of 360 samples by less than what
  // solvers differ by.
  EXPECT_GT(limit->smallest, 0.003);
  EXPECT_LT(limit->smallest, 0.1);
  const SceneDiagnosis below =
      diagnose({"{name: wrench_bias, force: [" + std::to_string(0.5 * limit->smallest) +
                ", 0, 0], moment: [0, 0, 0]}"});
  EXPECT_EQ(below.verdict.outcome, Outcome::adequate) << below.text;
  const SceneDiagnosis above =
      diagnose({"{name: wrench_bias, force: [" + std::to_string(3.0 * limit->smallest) +
                ", 0, 0], moment: [0, 0, 0]}"});
  EXPECT_EQ(above.verdict.outcome, Outcome::named) << above.text;
}

TEST(PlantCauses, AreThoseOfStiffnessAndMass) {
  ArmAtStem at;
  at.write_all();
  const std::vector<SceneFit> all = plant_causes(at.read());
  const auto has = [&](const std::string& name) {
    return std::ranges::any_of(all, [&](const SceneFit& one) { return one.effect.name == name; });
  };
  EXPECT_TRUE(has("base_compliance"));
  EXPECT_TRUE(has("weak_segment"));
  EXPECT_TRUE(has("stiffness_gradient"));
  EXPECT_TRUE(has("extra_mass"));
  EXPECT_FALSE(has("youngs_modulus"));
  EXPECT_FALSE(has("wind"));
  EXPECT_FALSE(has("latency"));
  EXPECT_FALSE(has("yield"));
}

}  // namespace
}  // namespace pedicel::discrepancy
