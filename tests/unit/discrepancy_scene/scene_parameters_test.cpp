// Numbers of a robot at a plant that are asked for by name, and effects carried over to it.
#include "plugins/discrepancy/scene_fit/scene_parameters.h"

#include <gmock/gmock.h>

#include "engine/core/check.h"
#include "plugins/discrepancy/procedure/transfer.h"
#include "plugins/discrepancy/scene_predict/scene_observe.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {
namespace {

class SceneParameters : public testing::Test {
 protected:
  SceneParameters() {
    how_.numerics.distance = 0.05;
    how_.numerics.dt = 2.0e-3;
  }
  Experiment made(const std::vector<std::string>& hidden) {
    at_.write_all();
    const Experiment plain = at_.read();
    SceneVariant variant;
    for (const std::string& text : hidden) variant.effects.push_back(scene_effect(text, plain));
    return observed_scene(plain, variant, how_);
  }
  ParameterFit fitted(const Experiment& experiment, const std::vector<std::string>& words) {
    const auto ground = scene_ground(experiment, 1, nullptr, how_.numerics);
    return fit_parameters(*ground,
                          requested_starts(experiment, scene_vocabulary(experiment), words), {});
  }
  std::string refusal(const std::vector<std::string>& words) {
    const Experiment experiment = made({});
    try {
      requested_starts(experiment, scene_vocabulary(experiment), words);
    } catch (const UsageError& fault) {
      return fault.what();
    }
    return "";
  }

  ArmAtStem at_;
  SceneObserveOptions how_;
};

TEST_F(SceneParameters, AreFoundWithIntervalsThatHoldThem) {
  const ParameterFit fit =
      fitted(made({"{name: wrench_gain, gain: 1.3}"}), {"wrench_gain.gain", "youngs_modulus"});
  ASSERT_EQ(fit.parameters.size(), 2u);
  const FittedParameter &gain = fit.parameters[0], &modulus = fit.parameters[1];
  EXPECT_EQ(gain.name, "wrench_gain.gain");
  EXPECT_NEAR(gain.value, 1.3, 0.01);
  EXPECT_LT(gain.low, 1.3);
  EXPECT_GT(gain.high, 1.3);
  // Of a single plant a modulus is told in pascals.
  EXPECT_EQ(modulus.unit, "Pa");
  EXPECT_LT(modulus.low, modulus.value);
  EXPECT_GT(modulus.high, modulus.value);
  ASSERT_EQ(fit.trials.size(), 1u);
  EXPECT_NEAR(fit.trials[0].rms, 1.0, 0.1);
  EXPECT_THAT(to_json(fit), testing::HasSubstr("\"force_std\""));
}

TEST_F(SceneParameters, AreAskedForByNamesThatTheSceneHas) {
  EXPECT_THAT(refusal({"wrench_gain.size"}), testing::HasSubstr("expected one of"));
  EXPECT_THAT(refusal({"no_effect.size"}), testing::HasSubstr("of a known effect"));
  EXPECT_THAT(refusal({"weak_segment.factor@twig:0.3"}), testing::HasSubstr("no curve \"twig\""));
}

TEST_F(SceneParameters, EffectsCarryOverWhereTheyAct) {
  const Experiment experiment = made({"{name: wrench_gain, gain: 1.3}"});
  const auto told = [&](const std::string& text) {
    const auto ground = scene_ground(experiment, 1, nullptr, how_.numerics);
    return transfer(*ground, {scene_effect(text, experiment)}, {});
  };
  const Transfer right = told("{name: wrench_gain, gain: 1.3}");
  EXPECT_THAT(right.effects, testing::ElementsAre("wrench_gain"));
  ASSERT_TRUE(right.gain);
  EXPECT_GT(*right.gain, 0.9);
  const Transfer wrong = told("{name: wrench_gain, gain: 0.8}");
  ASSERT_TRUE(wrong.gain);
  EXPECT_LT(*wrong.gain, 0.0);
}

}  // namespace
}  // namespace pedicel::discrepancy
