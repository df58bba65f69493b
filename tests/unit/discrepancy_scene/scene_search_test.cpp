#include "pedicel/discrepancy/scene_fit/scene_search.h"

#include <gmock/gmock.h>

#include <functional>

#include "arm_at_stem.h"
#include "pedicel/discrepancy/scene/scene_observe.h"

namespace pedicel::discrepancy {
namespace {

// Data of a variant with the instruments' noise, searched with the same mesh and step.
class SceneSearch : public testing::Test {
 protected:
  SceneFindings search(const std::vector<std::string>& hidden) {
    at_.write_all();
    const SceneExperiment plain = at_.read();
    SceneVariant variant;
    for (const std::string& text : hidden) variant.effects.push_back(scene_effect(text, plain));
    SceneObserveOptions how;
    how.numerics.distance = 0.05;
    how.numerics.dt = 2.0e-3;
    made_ = observed_scene(plain, variant, how);
    if (spoil_) spoil_(made_);
    const SceneDataSet data(made_);
    SceneSimulator simulator(made_, how.numerics, 1);
    SceneEvaluator evaluator(simulator, data);
    SceneSearchOptions options;
    options.trials = {0};
    if (made_.trials.size() > 1) options.check = {1};
    return search_scene(evaluator, options);
  }
  ArmAtStem at_;
  SceneExperiment made_;
  std::function<void(SceneExperiment&)> spoil_;  // what was measured
};

double value_of(const SceneFitResult& fit, const std::string& effect, const std::string& number) {
  for (int p = 0; p < fit.model.size(); ++p)
    if (fit.model.effects[fit.model.free[p].effect].name == effect &&
        fit.model.free[p].name == number)
      return fit.model.value(p);
  return std::nan("");
}

TEST_F(SceneSearch, NothingIsFoundWhereNothingIsHidden) {
  const SceneFindings found = search({});
  EXPECT_EQ(found.outcome, SceneFindings::Outcome::adequate);
  EXPECT_LT(found.nominal_excess, 0.4);
  EXPECT_TRUE(found.candidates.empty());
}

// The fitted trial is right. Of what acts in the other one alone nothing may be called adequate.
TEST_F(SceneSearch, ATrialHeldOutMayObject) {
  at_.trials += "  - {name: again, folder: push, robot: {follows: joints}}\n";
  EXPECT_EQ(search({}).outcome, SceneFindings::Outcome::adequate);
  spoil_ = [](SceneExperiment& made) { made.trials[1].wrenches[0].value *= 1.3; };
  EXPECT_EQ(search({}).outcome, SceneFindings::Outcome::unknown);
}

TEST_F(SceneSearch, AWrongGainIsFoundWithItsSize) {
  const SceneFindings found = search({"{name: wrench_gain, gain: 1.3}"});
  ASSERT_FALSE(found.candidates.empty());
  EXPECT_THAT(found.candidates.front().names, testing::ElementsAre("wrench_gain"));
  EXPECT_NEAR(value_of(found.candidates.front().fit, "wrench_gain", "gain"), 1.3, 0.01);
  EXPECT_LT(found.candidates.front().excess, 0.4);
}

}  // namespace
}  // namespace pedicel::discrepancy
