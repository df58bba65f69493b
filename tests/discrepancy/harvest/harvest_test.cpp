#include "tests/discrepancy/harvest/harvest.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/temporary_folder.h"

namespace pedicel::harvest {
namespace {

/// One harvest for a fit and one that is held out.
Options two_trials(std::vector<scene_case::Hidden> hidden) {
  Options options;
  options.trials = 2;
  options.hidden = std::move(hidden);
  return options;
}

std::set<std::string> names_in(const std::string& verdict) {
  std::set<std::string> names;
  const nlohmann::json all = nlohmann::json::parse(verdict);
  for (const auto& cause : all.at("causes")) names.insert(cause.at("name").get<std::string>());
  return names;
}

/// With all three things hidden.
struct Harvest : ::testing::Test {
  const TemporaryFolder folder;
  const scene_case::Setting setting = setting_of(two_trials(hidden_by_default()));
  const std::vector<scene_case::Run> runs = make_case(folder / "experiment", setting);
};

TEST_F(Harvest, ExtendedSceneForetellsTheHeldOutTrialBetter) {
  ASSERT_TRUE(runs[0].came_off && runs[1].came_off);

  const Diagnosed found = diagnose(folder / "experiment", folder / "diagnosis", 2);
  EXPECT_TRUE(found.is_believed) << found.findings;
  EXPECT_EQ(names_in(found.verdict),
            (std::set<std::string>{"contact_friction", "robot_latency", "detachment_threshold"}))
      << found.findings;
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
}

TEST(HarvestAsItsFilesSay, IsAdequate) {
  const TemporaryFolder folder;
  make_case(folder / "experiment", setting_of(two_trials({})));
  const Diagnosed found = diagnose(folder / "experiment", folder / "diagnosis", 2);
  EXPECT_EQ(nlohmann::json::parse(found.verdict).at("verdict"), "adequate") << found.findings;
  EXPECT_EQ(names_in(found.verdict), std::set<std::string>{}) << found.findings;
}

// What the program foretells with the true numbers is what two engines agree to.
TEST_F(Harvest, HiddenNumbersAgreeWithTheOtherEngine) {
  const Comparison all = compare(folder / "experiment", {}, setting, runs, 2);
  for (const Trial& trial : all.trials) {
    ASSERT_TRUE(trial.real.came_off && trial.hidden.came_off) << tables(all, "");
    EXPECT_NEAR(*trial.hidden.came_off, *trial.real.came_off, 0.008) << tables(all, "");
    EXPECT_LT(trial.hidden.rms_apart, 1.0e-3) << tables(all, "");
    EXPECT_LT(trial.hidden.misfit, 0.5 * trial.nominal.misfit) << tables(all, "");
  }
}

}  // namespace
}  // namespace pedicel::harvest
