// Every number that decides in a diagnosis is described once, and can be set by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/core/check.h"
#include "plugins/discrepancy/settings/scene_settings.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const void* address_of(const DiagnosisSetting& setting) {
  return std::visit([](auto* pointer) -> const void* { return pointer; }, setting.value);
}

std::size_t size_of(const DiagnosisSetting& setting) {
  return std::visit([](auto* pointer) { return sizeof *pointer; }, setting.value);
}

// Bytes of a part that no row stands for: none but what aligns its end.
template <class Part>
std::size_t bytes_left(const Part& part, const std::vector<DiagnosisSetting>& all) {
  std::set<const void*> known;
  std::size_t left = sizeof part;
  const auto* first = reinterpret_cast<const char*>(&part);
  for (const DiagnosisSetting& setting : all) {
    const auto* here = static_cast<const char*>(address_of(setting));
    if (here >= first && here < first + sizeof part && known.insert(here).second)
      left -= size_of(setting);
  }
  return left;
}

TEST(DiagnosisSettings, DescribeEveryFieldOnce) {
  DiagnosisSettings settings;
  const std::vector<DiagnosisSetting> all = described(settings);
  EXPECT_LT(bytes_left(settings.levels, all), alignof(double));
  EXPECT_LT(bytes_left(settings.evidence, all), alignof(double));
  EXPECT_LT(bytes_left(settings.budget, all), alignof(double));
  EXPECT_LT(bytes_left(settings.accuracy, all), alignof(double));
  std::set<std::string> names;
  std::set<const void*> addresses;
  for (const DiagnosisSetting& setting : all) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    EXPECT_TRUE(addresses.insert(address_of(setting)).second) << setting.name;
  }
}

TEST(SceneSettings, DescribeEveryFieldOnce) {
  SceneSettings settings;
  const std::vector<DiagnosisSetting> all = described(settings);
  EXPECT_LT(bytes_left(settings.search, all), alignof(double));
  EXPECT_LT(bytes_left(settings.fit, all), alignof(double));
  EXPECT_LT(bytes_left(settings.outside, all), alignof(double));
  EXPECT_LT(bytes_left(settings.robot, all), alignof(double));
  EXPECT_LT(bytes_left(settings.symptoms, all), alignof(double));
  std::set<std::string> names;
  for (const DiagnosisSetting& setting : all)
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
}

void expect_whole(const std::vector<DiagnosisSetting>& all) {
  const auto units = known_units();
  for (const DiagnosisSetting& setting : all) {
    EXPECT_TRUE(setting.sentence.ends_with('.')) << setting.name;
    EXPECT_TRUE(setting.doubled.ends_with('.')) << setting.name;
    EXPECT_FALSE(setting.source.empty()) << setting.name;
    EXPECT_NE(std::ranges::find(units, setting.unit), units.end()) << setting.unit;
    EXPECT_GE(setting.get(), setting.minimum) << setting.name;
    EXPECT_LE(setting.get(), setting.maximum) << setting.name;
    EXPECT_GT(setting.get(), 0.0) << setting.name;  // or half and twice of it would be the same
  }
}

TEST(DiagnosisSettings, SayWhatAndWhy) {
  DiagnosisSettings settings;
  expect_whole(described(settings));
}

TEST(SceneSettings, SayWhatAndWhy) {
  SceneSettings settings;
  expect_whole(described(settings));
}

TEST(SceneSettings, AreSetByNameAndSaid) {
  SceneSettings settings;
  EXPECT_TRUE(changed_settings(settings).empty());
  set_setting(settings, "search.floor=0.7");
  set_setting(settings, "robot.places=40");
  EXPECT_EQ(settings.search.floor, 0.7);
  EXPECT_EQ(settings.robot.places, 40);
  EXPECT_EQ(default_scene_settings().search.floor, 0.35);
  EXPECT_THAT(changed_settings(settings),
              testing::ElementsAre("setting search.floor is 0.7 in place of 0.35",
                                   "setting robot.places is 40 in place of 80"));
}

TEST(SceneSettings, AreOthersThanThoseOfAPlant) {
  SceneSettings scene;
  DiagnosisSettings plant;
  EXPECT_THAT([&] { set_setting(scene, "levels.clear_odds=4"); },
              ThrowsMessage<UsageError>(HasSubstr("`pedicel manual scene_settings`")));
  EXPECT_THAT([&] { set_setting(plant, "search.floor=0.5"); },
              ThrowsMessage<UsageError>(HasSubstr("`pedicel manual diagnosis_settings`")));
  EXPECT_THAT([&] { set_setting(scene, "search.floor"); },
              ThrowsMessage<UsageError>(HasSubstr("as search.floor=0.5")));
  EXPECT_THAT([&] { set_setting(scene, "fit.first_step=0"); },
              ThrowsMessage<UsageError>(HasSubstr("must be between")));
}

TEST(DiagnosisSettings, AreSetByName) {
  DiagnosisSettings settings;
  set_setting(settings, "levels.clear_odds=4.5");
  set_setting(settings, "budget.leaders=12");
  EXPECT_EQ(settings.levels.clear_odds, 4.5);
  EXPECT_EQ(settings.budget.leaders, 12);
  EXPECT_EQ(default_settings().levels.clear_odds, 3.0);
}

TEST(DiagnosisSettings, RefuseWhatTheyCannotBe) {
  const auto set = [](const std::string& assignment) {
    return [assignment] {
      DiagnosisSettings settings;
      set_setting(settings, assignment);
    };
  };
  EXPECT_THAT(set("levels.odds=4"), ThrowsMessage<UsageError>(HasSubstr("\"levels.odds\"")));
  EXPECT_THAT(set("levels.clear_odds"), ThrowsMessage<UsageError>(HasSubstr("NAME=NUMBER")));
  EXPECT_THAT(set("levels.clear_odds="), ThrowsMessage<UsageError>(HasSubstr("NAME=NUMBER")));
  EXPECT_THAT(set("levels.clear_odds=4x"), ThrowsMessage<UsageError>(HasSubstr("NAME=NUMBER")));
  EXPECT_THAT(set("levels.clear_odds=nan"), ThrowsMessage<UsageError>(HasSubstr("finite")));
  EXPECT_THAT(set("levels.clear_odds=-1"), ThrowsMessage<UsageError>(HasSubstr("between 0 and")));
  EXPECT_THAT(set("budget.leaders=2.5"), ThrowsMessage<UsageError>(HasSubstr("whole number")));
  EXPECT_THAT(set("budget.lost_early=1.2"), ThrowsMessage<UsageError>(HasSubstr("0 and 1")));
}

}  // namespace
}  // namespace pedicel::discrepancy
