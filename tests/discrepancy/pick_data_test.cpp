// Thirty-two real picks of apples, 22 that came off and 10 that did not, mostly because the hand
// slid off (OSUrobotics, PickApp, commit 643f1f1, MIT). The peak of the force does not tell them
// apart. The two numbers that do are fitted anew without each record before it is judged.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "plugins/discrepancy/pick/pick_labels.h"
#include "tests/support/places.h"

namespace pedicel::discrepancy {
namespace {

const std::filesystem::path folder = pedicel::test::shared_folder() / "data/apple_picks";

class PickData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
    Diagnostics diagnostics;
    ImportNotes notes;
    labels_ = read_pick_labels(folder / "picks.csv", diagnostics);
    for (const PickLabel& label : labels_) {
      JudgedPick judged;
      judged.record =
          read_pick_record(folder / ("pick_" + label.name + ".csv"), {}, diagnostics, notes);
      judged.pick = judge_pick(judged.record);
      picks_.push_back(std::move(judged));
    }
    ASSERT_EQ(diagnostics.text(), "");
    ASSERT_TRUE(notes.missing.empty());
  }

  std::vector<double> values(bool came_off, double (*value)(const Pick&)) const {
    std::vector<double> found;
    for (std::size_t i = 0; i < picks_.size(); ++i)
      if (labels_[i].came_off == came_off) found.push_back(value(picks_[i].pick));
    return found;
  }

  std::vector<PickLabel> labels_;
  std::vector<JudgedPick> picks_;
};

TEST_F(PickData, LabelsAreRightAlsoWithoutTheRecordItself) {
  const LabelledPicks found = compare_with_labels(picks_, labels_);
  ASSERT_EQ(found.rows.size(), 32u);
  RecordProperty("right", found.right());
  RecordProperty("right_left_out", found.right_alone());
  RecordProperty("response_ms", std::to_string(1e3 * found.response));
  RecordProperty("sharpness", std::to_string(found.sharpness));
  EXPECT_GE(found.right(), 31);
  EXPECT_GE(found.right_alone(), 30);
  // A quarter of the period with which these arms swing after a break is what the labels give, too.
  EXPECT_NEAR(found.response, PickSettings().response, 0.008);
}

// Nothing else that was chosen decides.
TEST_F(PickData, LabelsDoNotHangOnTheLevels) {
  for (const double level : {0.1, 0.2})
    for (const double share : {0.3, 0.7}) {
      PickSettings settings;
      settings.level = level;
      settings.share = share;
      std::vector<JudgedPick> anew = picks_;
      for (JudgedPick& judged : anew) judged.pick = judge_pick(judged.record, settings);
      EXPECT_GE(compare_with_labels(anew, labels_).right(), 30) << level << " s, " << share;
    }
}

TEST_F(PickData, TheForceDoesNotTellWhatTheTimeTells) {
  const auto peak = [](const Pick& pick) { return pick.peak_force; };
  const auto half = [](const Pick& pick) { return pick.fall->half.value_or(1.0); };
  const auto off = values(true, half), failed = values(false, half);
  EXPECT_LT(middle_of(off), 0.01);
  EXPECT_GT(middle_of(failed), 0.04);
  EXPECT_NEAR(middle_of(values(true, peak)), middle_of(values(false, peak)), 6.0);
}

}  // namespace
}  // namespace pedicel::discrepancy
