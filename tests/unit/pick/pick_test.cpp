// How a pick ended, on records whose end and moment are known. A break takes the stalk's force away
// in no time; what is left of its sharpness is the sensor's filter. The arm then swings freely.
#include "plugins/discrepancy/pick/pick.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/check.h"
#include "tests/unit/pick/made_pick.h"

namespace pedicel::discrepancy {
namespace {

using pedicel::testing::drawn_pick;
using pedicel::testing::MadePick;
using pedicel::testing::make_pick;
using ::testing::HasSubstr;

constexpr int seeds = 200;

TEST(Pick, FindsTheMomentOfABreak) {
  int within = 0, covered = 0, named = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const MadePick made = drawn_pick(MadePick::End::breaks, static_cast<std::uint64_t>(seed));
    const Pick pick = judge_pick(make_pick(made));
    if (pick.end != Pick::End::came_off) continue;
    ++named;
    const double error = std::abs(*pick.time() - made.moment);
    within += error <= 0.03;
    covered += error <= 2.0 * pick.fall->onset_error;
  }
  RecordProperty("named", named);
  RecordProperty("within_30_ms", within);
  RecordProperty("covered", covered);
  EXPECT_GE(within, 0.95 * seeds);
  EXPECT_GE(covered, 0.9 * named);
  EXPECT_GE(named, 0.95 * seeds);
}

TEST(Pick, TellsSlipsFromBreaks) {
  int named = 0, began = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const MadePick made = drawn_pick(MadePick::End::slips, static_cast<std::uint64_t>(seed));
    const Pick pick = judge_pick(make_pick(made));
    named += pick.outcome() == "failed";
    began += pick.time() && std::abs(*pick.time() - made.moment) <= 0.1;
  }
  RecordProperty("named", named);
  RecordProperty("began_within_100_ms", began);
  EXPECT_GE(named, 0.95 * seeds);
  EXPECT_GE(began, 0.8 * seeds);  // some slide a little before they are said to slip
}

TEST(Pick, TakesNothingForABreakThatHolds) {
  int named = 0;
  for (int seed = 1; seed <= seeds; ++seed)
    named +=
        judge_pick(make_pick(drawn_pick(MadePick::End::holds, static_cast<std::uint64_t>(seed))))
            .end == Pick::End::held;
  RecordProperty("named", named);
  EXPECT_EQ(named, seeds);
}

// Far above the noise, with a filter faster than the grip gives way, no end may be taken for
// another.
TEST(Pick, IsNeverWrongAtStrongContrast) {
  for (const auto end : {MadePick::End::breaks, MadePick::End::slips, MadePick::End::holds})
    for (int seed = 1; seed <= seeds; ++seed) {
      MadePick made = drawn_pick(end, static_cast<std::uint64_t>(seed));
      made.force = std::max(made.force, 10.0);
      made.noise = std::min(made.noise, 0.1);
      made.cutoff = std::max(made.cutoff, 30.0);
      made.slip_time = std::max(made.slip_time, 0.2);
      const Pick pick = judge_pick(make_pick(made));
      const char* expected = end == MadePick::End::breaks ? "detached" : "failed";
      EXPECT_EQ(pick.outcome(), expected) << "seed " << seed << ": " << pick.sentence();
    }
}

// A slow sensor smears a break out; one of 5 Hz needs another response, as the manual says.
TEST(Pick, SlowSensors) {
  const auto named = [](MadePick::End end, double cutoff, const PickSettings& settings) {
    int right = 0;
    for (int seed = 1; seed <= 100; ++seed) {
      MadePick made = drawn_pick(end, static_cast<std::uint64_t>(seed));
      made.rate = 50.0;
      made.cutoff = cutoff;
      made.slip_time = std::max(made.slip_time, 0.3);
      const Pick pick = judge_pick(make_pick(made), settings);
      right += pick.outcome() == (end == MadePick::End::breaks ? "detached" : "failed");
    }
    return right;
  };
  EXPECT_GE(named(MadePick::End::breaks, 10.0, {}), 95);
  EXPECT_LE(named(MadePick::End::breaks, 5.0, {}), 50);
  PickSettings slow;
  slow.response = 0.06;
  EXPECT_GE(named(MadePick::End::breaks, 5.0, slow), 95);
  EXPECT_GE(named(MadePick::End::slips, 5.0, slow), 95);
}

TEST(Pick, SaysHowSureItIs) {
  EXPECT_NEAR(probability_of_break(0.025, 0.0, 0.025, 3.0), 0.5, 1e-12);
  EXPECT_NEAR(probability_of_break(0.0125, 0.0, 0.025, 3.0), 8.0 / 9.0, 1e-12);
  EXPECT_LT(probability_of_break(0.0125, 0.02, 0.025, 3.0), 8.0 / 9.0);
  MadePick slow;  // one sample in a swing says nothing of how fast a fall was
  slow.rate = 10.0;
  MadePick quick;
  const Pick seen = judge_pick(make_pick(quick)), hardly = judge_pick(make_pick(slow));
  ASSERT_TRUE(seen.probability && hardly.probability);
  EXPECT_GT(*seen.probability, 0.95);
  EXPECT_LT(*hardly.probability, 0.9);
  EXPECT_GT(hardly.fall->onset_error, 4.0 * seen.fall->onset_error);
}

TEST(Pick, GivesForcesAboveTheirZero) {
  MadePick made;
  made.turning = 0.0;
  const Pick pick = judge_pick(make_pick(made));
  EXPECT_NEAR(pick.peak_force, made.force, 0.5);
  EXPECT_NEAR(pick.peak_time, made.moment, 0.05);
  EXPECT_NEAR(pick.noise, made.noise, 0.02);
}

TEST(Pick, OneAxisIsEnough) {
  PickRecord record = make_pick({});
  const Pick whole = judge_pick(record);
  record.force = Eigen::MatrixXd(-(record.force.col(2)));  // a sensor mounted upside down
  const Pick pick = judge_pick(record);
  EXPECT_EQ(pick.end, Pick::End::came_off);
  EXPECT_NEAR(*pick.time(), *whole.time(), 0.01);
}

TEST(Pick, PassesOverGapsAndSpikes) {
  PickRecord record = make_pick({});
  record.force(100, 1) = 300.0;
  record.force(300, 2) = -300.0;
  for (const int row : {50, 51, 420}) record.force.row(row).setConstant(NAN);
  record.force(200, 0) = NAN;
  const Pick pick = judge_pick(record);
  EXPECT_EQ(pick.end, Pick::End::came_off);
  EXPECT_NEAR(*pick.time(), 2.0, 0.01);
  EXPECT_LT(pick.peak_force, 20.0);
}

TEST(Pick, FastRecordsGiveTheSame) {
  MadePick made;
  made.rate = 5000.0;
  const Pick pick = judge_pick(make_pick(made));
  EXPECT_EQ(pick.end, Pick::End::came_off);
  EXPECT_NEAR(*pick.time(), made.moment, 0.01);
}

PickRecord cut(PickRecord record, int rows) {
  record.time.resize(static_cast<std::size_t>(rows));
  record.force.conservativeResize(rows, Eigen::NoChange);
  return record;
}

TEST(Pick, SaysWhyItCannotTell) {
  const PickRecord record = make_pick({});
  const auto why = [](const PickRecord& one) {
    const Pick pick = judge_pick(one);
    EXPECT_EQ(pick.outcome(), "unclear");
    EXPECT_FALSE(pick.time());
    return pick.why;
  };
  EXPECT_THAT(why({}), HasSubstr("fewer than three samples"));
  EXPECT_THAT(why(cut(record, 2)), HasSubstr("fewer than three samples"));
  EXPECT_THAT(why(cut(record, 60)), HasSubstr("within its noise"));
  const auto at =
      static_cast<int>(std::ranges::lower_bound(record.time, 2.03) - record.time.begin());
  EXPECT_THAT(why(cut(record, at)), HasSubstr("ends while the force falls"));
  PickRecord brief = record;  // 60 ms with all of the load in it
  for (double& t : brief.time) t *= 0.015;
  EXPECT_THAT(why(brief), HasSubstr("too short"));
}

TEST(Pick, RefusesSettingsOutOfRange) {
  PickSettings settings;
  EXPECT_EQ(check(settings), "");
  settings.response = 0.0;
  EXPECT_EQ(check(settings), "response = 0 s: must be above 0 and at most 10 s");
  EXPECT_THROW(judge_pick(make_pick({}), settings), UsageError);
  settings = {};
  settings.share = 1.5;
  EXPECT_THAT(check(settings), HasSubstr("share = 1.5"));
  settings = {};
  settings.sharpness = NAN;
  EXPECT_THAT(check(settings), HasSubstr("sharpness = nan"));
}

}  // namespace
}  // namespace pedicel::discrepancy
