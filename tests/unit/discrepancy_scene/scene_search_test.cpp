#include "plugins/discrepancy/scene_fit/scene_search.h"

#include <gmock/gmock.h>

#include <functional>

#include "plugins/discrepancy/scene_predict/scene_observe.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {
namespace {

// Data of a variant with the instruments' noise, searched with the same mesh and step.
class SceneSearch : public testing::Test {
 protected:
  SceneFindings search(const std::vector<std::string>& hidden) {
    at_.write_all();
    const Experiment plain = at_.read();
    SceneVariant variant;
    for (const std::string& text : hidden) variant.effects.push_back(scene_effect(text, plain));
    SceneObserveOptions how;
    how.numerics.distance = 0.05;
    how.numerics.dt = 2.0e-3;
    made_ = observed_scene(plain, variant, how);
    if (spoil_) spoil_(made_);
    const SceneDataSet data(made_);
    SceneSimulator simulator(made_, how.numerics, 1);
    SceneEvaluator evaluator(simulator, data, settings_);
    SceneSearchOptions options;
    options.trials = {0};
    if (made_.trials.size() > 1) options.check = {1};
    return search_scene(evaluator, options);
  }
  ArmAtStem at_;
  Experiment made_;
  SceneSettings settings_;
  std::function<void(Experiment&)> spoil_;  // what was measured
};

double value_of(const FitSummary& fit, const std::string& effect, const std::string& number) {
  for (int p = 0; p < fit.hypothesis.size(); ++p)
    if (fit.hypothesis.effects[fit.hypothesis.free[p].effect].name == effect &&
        fit.hypothesis.free[p].name == number)
      return fit.hypothesis.value(p);
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
  spoil_ = [](Experiment& made) { made.trials[1].wrenches[0].value *= 1.3; };
  EXPECT_EQ(search({}).outcome, SceneFindings::Outcome::unknown);
}

TEST_F(SceneSearch, AWrongGainIsFoundWithItsSize) {
  const SceneFindings found = search({"{name: wrench_gain, gain: 1.3}"});
  ASSERT_FALSE(found.candidates.empty());
  EXPECT_THAT(found.candidates.front().names, testing::ElementsAre("wrench_gain"));
  EXPECT_NEAR(value_of(found.candidates.front().fit, "wrench_gain", "gain"), 1.3, 0.01);
  EXPECT_LT(found.candidates.front().excess, 0.4);
  // It pays for its own number, and not for those that the baseline has, too.
  const FitSummary &with = found.candidates.front().fit, &without = found.baseline;
  EXPECT_NEAR(
      found.baseline_cost - found.candidates.front().cost,
      0.5 * (without.misfit().square - with.misfit().square) - 0.5 * std::log(with.misfit().count),
      1.0e-6);
}

// On an arm of one joint a tool that sits elsewhere, six numbers, does all that an encoder's zero
// does, and its linear prediction takes more of it.
TEST_F(SceneSearch, ACauseOfOneNumberIsRefittedWhateverOthersTakeInTheLinear) {
  settings_.search.refits = 1;  // a second candidate is one of fewer numbers
  const SceneFindings found = search({"{name: joint_offset, joint: turn, offset: 0.005}"});
  EXPECT_EQ(found.outcome, SceneFindings::Outcome::named);
  ASSERT_GT(found.candidates.size(), 1u) << findings_text(found, made_);
  EXPECT_THAT(found.candidates.front().names, testing::ElementsAre("joint_offset"))
      << findings_text(found, made_);
  EXPECT_NEAR(value_of(found.candidates.front().fit, "joint_offset", "offset"), 0.005, 5.0e-4);
}

// At rest they are the same: what parts them is that a load has to be moved along.
TEST_F(SceneSearch, ALoadIsToldFromABiasThatPullsDown) {
  const SceneFindings load = search({"{name: payload, mass: 0.06, centre: [0, 0, 0.05]}"});
  EXPECT_EQ(load.outcome, SceneFindings::Outcome::named);
  ASSERT_FALSE(load.candidates.empty());
  EXPECT_THAT(load.candidates.front().names, testing::ElementsAre("payload"));
  const SceneFindings bias = search({"{name: wrench_bias, force: [0, 0, -0.59]}"});
  EXPECT_EQ(bias.outcome, SceneFindings::Outcome::named);
  ASSERT_FALSE(bias.candidates.empty());
  EXPECT_THAT(bias.candidates.front().names, testing::ElementsAre("wrench_bias"));
  // Of a light one the inertia drowns in the noise, and a bias may not be told in its place.
  const SceneFindings light = search({"{name: payload, mass: 0.02, centre: [0, 0, 0.02]}"});
  EXPECT_EQ(light.outcome, SceneFindings::Outcome::ambiguous) << findings_text(light, made_);
}

// Noise that nobody states is estimated, and is no finding.
TEST_F(SceneSearch, NoiseThatIsNotStatedIsEstimated) {
  spoil_ = [](Experiment& made) { made.noise = {}; };
  const SceneFindings found = search({});
  EXPECT_EQ(found.outcome, SceneFindings::Outcome::adequate);
  EXPECT_LT(found.nominal_excess, 0.35);
  const SceneDataSet data(made_);
  EXPECT_NEAR(data.deviation(SceneChannel::pixel), 0.4, 0.04);
  EXPECT_NEAR(data.deviation(SceneChannel::position), 3.0e-4, 3.0e-5);
  EXPECT_NEAR(data.deviation(SceneChannel::force), 0.03, 0.003);
}

FitSummary leaving(const Eigen::VectorXd& residual) {
  FitSummary fit;
  fit.residual = residual;
  fit.samples = static_cast<int>(residual.size());
  return fit;
}

TEST(Between, IsWhereDataLieOnTheWayFromOneModelToTheOther) {
  // What is measured less what each foretells: a quarter of the way from the first.
  const Eigen::Vector3d first(1.0, 0.0, 0.0), second(-3.0, 0.0, 0.0);
  const Between data = between(leaving(first), leaving(second));
  EXPECT_DOUBLE_EQ(data.at, 0.25);
  EXPECT_DOUBLE_EQ(data.error, 0.25);
  EXPECT_DOUBLE_EQ(between(leaving(second), leaving(first)).at, 0.75);
  // What lies across that way says nothing of it, but counts as noise.
  const Between noisy = between(leaving(first + Eigen::Vector3d(0.0, 9.0, 0.0)),
                                leaving(second + Eigen::Vector3d(0.0, 9.0, 0.0)));
  EXPECT_DOUBLE_EQ(noisy.at, 0.25);
  EXPECT_GT(noisy.error, 1.0);
  EXPECT_TRUE(std::isinf(between(leaving(first), leaving(first)).error));
}

}  // namespace
}  // namespace pedicel::discrepancy
