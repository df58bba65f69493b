// What is said of a pick, to people and to machines.
#include "plugins/discrepancy/pick/pick_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/pick/pick_report.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/pick/made_pick.h"

namespace pedicel::discrepancy {
namespace {

using pedicel::testing::MadePick;
using pedicel::testing::make_pick;
using ::testing::HasSubstr;

JudgedPick judged(MadePick::End end, double moment = 2.0) {
  MadePick made;
  made.end = end;
  made.moment = moment;
  JudgedPick result{make_pick(made), {}};
  result.pick = judge_pick(result.record);
  return result;
}

TEST(PickText, SaysWhatHappened) {
  EXPECT_THAT(to_text(judged(MadePick::End::breaks)), HasSubstr("The fruit came off at 2.00"));
  EXPECT_THAT(to_text(judged(MadePick::End::slips)), HasSubstr("the hand slipped from 2.0"));
  EXPECT_THAT(to_text(judged(MadePick::End::holds)), HasSubstr("of the load was still there"));
  EXPECT_THAT(to_text({{}, judge_pick({})}), HasSubstr("cannot be told: fewer than three samples"));
}

TEST(PickText, JsonHasANumberOrNothing) {
  const auto one = nlohmann::json::parse(to_json({judged(MadePick::End::breaks)}));
  EXPECT_EQ(one.at("format"), "pedicel-pick");
  EXPECT_EQ(one.at("outcome"), "detached");
  EXPECT_EQ(one.at("end"), "came_off");
  EXPECT_NEAR(one.at("moment_s").get<double>(), 2.0, 0.01);
  EXPECT_GT(one.at("probability_detached").get<double>(), 0.9);
  const auto several = nlohmann::json::parse(
      to_json({judged(MadePick::End::slips), judged(MadePick::End::holds), JudgedPick{}}));
  ASSERT_EQ(several.size(), 3u);
  EXPECT_EQ(several[0].at("end"), "slipped");
  EXPECT_EQ(several[1].at("end"), "held");
  EXPECT_EQ(several[1].at("outcome"), "failed");
  EXPECT_TRUE(several[1].at("moment_s").is_null());
  EXPECT_EQ(several[2].at("outcome"), "unclear");
  EXPECT_TRUE(several[2].at("load_before_N").is_null());
}

TEST(PickText, ATableHasARowARecord) {
  const std::string table =
      to_table({judged(MadePick::End::breaks), judged(MadePick::End::holds), JudgedPick{}});
  EXPECT_EQ(std::ranges::count(table, '\n'), 4);
  EXPECT_THAT(table, HasSubstr("made.csv  detached  came_off"));
}

TEST(PickText, AReportShowsEachRecord) {
  const TemporaryFolder folder;
  write_pick_report(folder / "picks.html", {judged(MadePick::End::breaks), JudgedPick{}}, {});
  const std::string page = io::read_file(folder / "picks.html");
  EXPECT_THAT(page, HasSubstr("The fruit came off at 2.00"));
  EXPECT_THAT(page, HasSubstr("along the pull"));
  EXPECT_THAT(page, HasSubstr("came off</text>"));
}

}  // namespace
}  // namespace pedicel::discrepancy
