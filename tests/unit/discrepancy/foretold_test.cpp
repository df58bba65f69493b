// Where trials rest and how fast they swing, measured over foretold, where both are known.
#include "plugins/discrepancy/test/foretold.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

constexpr int let_go = 0, weighed = 1, led = 2;  // trials of the made data

/// The made plant, which under its weight goes `softer` times as far as the model and swings
/// `slower` times as slowly.
std::vector<Foretold> foretold_of(MadeData& made, double softer, double slower) {
  made.add_noise(3);
  const double w = 2.0 * M_PI * MadeData::frequency, z = MadeData::damping;
  const auto swing = [z](double t, double rate) {
    return 0.04 * std::exp(-rate * z / std::sqrt(1.0 - z * z) * t) * std::cos(rate * t);
  };
  made.change([&](int trial, double t, int, const Vec3& p) -> Vec3 {
    const double share = std::pow(p.z() / 0.6, 2);
    if (trial == let_go && t >= 1.0)
      return {share * (swing(t - 1.0, w / slower) - swing(t - 1.0, w)), 0, 0};
    if (trial == weighed && t >= 4.0) return {share * 0.03 * (softer - 1.0), 0, 0};
    return Vec3::Zero();
  });
  DataSet data(made.experiment);
  data.set_noise(white_noise(MadeData::position_std), white_noise(MadeData::force_std));
  return foretold(made.experiment, data, made.predictions);
}

const Foretold* one_of(const std::vector<Foretold>& all, int trial, Foretold::What what) {
  for (const Foretold& one : all)
    if (one.trial == trial && one.what == what) return &one;
  return nullptr;
}

TEST(Foretold, WaysAtRestAndFrequencies) {
  MadeData made;
  const std::vector<Foretold> all = foretold_of(made, 1.12, 1.03);
  const Foretold *rest = one_of(all, weighed, Foretold::What::rest),
                 *swing = one_of(all, let_go, Foretold::What::frequency);
  ASSERT_TRUE(rest);
  ASSERT_TRUE(swing);
  EXPECT_NEAR(rest->off, 0.12, 3.0 * rest->error);
  EXPECT_LT(rest->error, 0.01);
  EXPECT_NEAR(swing->off, 1.0 / 1.03 - 1.0, 3.0 * swing->error);
  EXPECT_LT(swing->error, 0.01);
  // Nothing swings freely under weights that are put on gently, and the push ends as it was drawn.
  EXPECT_FALSE(one_of(all, weighed, Foretold::What::frequency));
  EXPECT_FALSE(one_of(all, led, Foretold::What::rest));
}

TEST(Foretold, SaysWhatIsMissing) {
  MadeData soft;
  const std::string missing =
      foretold_text(soft.experiment, foretold_of(soft, 1.12, 1.03), {let_go, weighed});
  EXPECT_THAT(missing,
              HasSubstr("Not predicted within 5 %: in trial \"weights\" the plant rests 12"));
  EXPECT_THAT(missing, HasSubstr("farther from its drawn shape than the model."));
  EXPECT_THAT(missing, HasSubstr("Its swings are predicted."));
  EXPECT_THAT(missing, HasSubstr("another one at rest than in swings; that would make relaxation"));
  MadeData fast;
  const std::string swings =
      foretold_text(fast.experiment, foretold_of(fast, 1.01, 0.9), {let_go, weighed});
  EXPECT_THAT(swings, HasSubstr("in trial \"release\" it swings 11"));
  EXPECT_THAT(swings, HasSubstr("faster than the model. Its places at rest are predicted."));
  MadeData right;
  const std::vector<Foretold> all = foretold_of(right, 1.02, 1.01);
  EXPECT_EQ(foretold_text(right.experiment, all, {let_go, weighed}),
            "Places at rest and frequencies of the trials held out are predicted within 5 %.");
  // Of a trial that shows neither nothing is said.
  EXPECT_EQ(foretold_text(right.experiment, all, {led}), "");
}

// The fitted trial is foretold, and another one of its kind under another load is not.
TEST(Foretold, SaysWhatDependsOnTheLoad) {
  MadeData made;
  const std::vector<Foretold> all{{let_go, Foretold::What::rest, 0.01, 0.001},
                                  {weighed, Foretold::What::rest, 0.14, 0.001},
                                  {weighed, Foretold::What::frequency, -0.02, 0.001}};
  const std::string missing = foretold_text(made.experiment, all, {weighed});
  EXPECT_THAT(missing, HasSubstr("under another load than in the fitted trials"));
  EXPECT_THAT(missing, HasSubstr("material_nonlinearity"));
}

}  // namespace
}  // namespace pedicel::discrepancy
