#include "discrepancy/harvest/harvest.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace pedicel::harvest {
namespace {

/// One harvest for a fit and one that is held out, with all three things hidden.
struct Harvest : ::testing::Test {
  static Options two_trials() {
    Options options;
    options.trials = 2;
    options.hidden = hidden_by_default();
    return options;
  }
  const TemporaryFolder folder;
  const scene_case::Setting setting = setting_of(two_trials());
  const std::vector<scene_case::Run> runs = make_case(folder / "experiment", setting);
};

TEST_F(Harvest, ExtendedSceneForetellsTheHeldOutTrialBetter) {
  ASSERT_TRUE(runs[0].came_off && runs[1].came_off);

  const Diagnosed found = diagnose(folder / "experiment", folder / "diagnosis", 2);
  ASSERT_FALSE(found.extended.empty()) << found.findings;
  const Comparison all = compare(folder / "experiment", found.extended, setting, runs, 2);
  const Trial& held_out = all.held_out();
  const std::string told = tables(said_of(setting, found.verdict), found.verdict) +
                           tables(all, "extended") + found.findings;
  ASSERT_TRUE(held_out.extended) << told;
  EXPECT_LT(held_out.extended->misfit, 0.5 * held_out.nominal.misfit) << told;
  EXPECT_LT(held_out.extended->rms_apart, held_out.nominal.rms_apart) << told;
  const auto late = [&](const Course& course) {
    return course.came_off ? std::abs(*course.came_off - *held_out.real.came_off) : 1.0;
  };
  EXPECT_LT(late(*held_out.extended), late(held_out.nominal)) << told;
  // What is not named is named in the table.
  EXPECT_NE(told.find("detachment_threshold"), std::string::npos);
}

// What the program foretells with the true numbers is what two engines agree to.
TEST_F(Harvest, HiddenNumbersAgreeWithTheOtherEngine) {
  const Comparison all = compare(folder / "experiment", {}, setting, runs, 2);
  for (const Trial& trial : all.trials) {
    ASSERT_TRUE(trial.real.came_off && trial.hidden.came_off) << tables(all, "");
    EXPECT_NEAR(*trial.hidden.came_off, *trial.real.came_off, 0.02) << tables(all, "");
    EXPECT_LT(trial.hidden.rms_apart, 1.5e-3) << tables(all, "");
    EXPECT_LT(trial.hidden.misfit, 0.5 * trial.nominal.misfit) << tables(all, "");
  }
}

}  // namespace
}  // namespace pedicel::harvest
