// Labels of picks, and what is learnt of them.
#include "plugins/discrepancy/pick/pick_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<PickLabel> read(const std::string& text, std::string* faults = nullptr) {
  const TemporaryFolder folder;
  io::write_file_atomically(folder / "picks.csv", text);
  Diagnostics diagnostics;
  const auto labels = read_pick_labels(folder / "picks.csv", diagnostics);
  if (faults)
    *faults = diagnostics.text();
  else
    EXPECT_EQ(diagnostics.text(), "");
  return labels;
}

TEST(PickLabels, AreReadAndRefused) {
  const auto labels = read("pick,outcome,note\n06,detached,a\n07,Slipped,b\nx,held,\n");
  ASSERT_EQ(labels.size(), 3u);
  EXPECT_EQ(labels[0].name, "06");
  EXPECT_TRUE(labels[0].came_off);
  EXPECT_FALSE(labels[1].came_off);
  std::string faults;
  read("pick,outcome\n06,maybe\n", &faults);
  EXPECT_THAT(faults, HasSubstr("picks.csv:2:4: error: \"maybe\" is no outcome"));
  read("nr,outcome\n06,held\n", &faults);
  EXPECT_THAT(faults, HasSubstr("picks.csv:1:1: error: expected a column pick"));
}

/// Half of the load went within `half` s.
JudgedPick timed(const std::string& file, double half) {
  JudgedPick judged;
  judged.record.file = file;
  judged.pick.end = half < 0.025 ? Pick::End::came_off : Pick::End::slipped;
  judged.pick.probability = probability_of_break(half, 0.0, 0.025, 3.0);
  judged.pick.fall = Fall{};
  judged.pick.fall->half = half;
  return judged;
}

// On a slower arm breaks take 30 to 50 ms and slips 200 to 300 ms: the labels say where they part.
TEST(PickLabels, CalibrateAnotherArm) {
  std::vector<JudgedPick> all;
  std::vector<PickLabel> labels;
  for (int i = 0; i < 10; ++i) {
    const bool off = i % 2 == 0;
    all.push_back(
        timed("p_" + std::to_string(i) + ".csv", off ? 0.03 + 0.002 * i : 0.2 + 0.01 * i));
    labels.push_back({std::to_string(i), off, {}});
  }
  const LabelledPicks found = compare_with_labels(all, labels);
  ASSERT_EQ(found.rows.size(), 10u);
  EXPECT_EQ(found.right(), 5);
  EXPECT_EQ(found.right_alone(), 10);
  EXPECT_GT(found.response, 0.05);
  EXPECT_LT(found.response, 0.2);
  EXPECT_THAT(found.to_text(), HasSubstr("10 of 10 right\nthese labels give --response 0."));
}

TEST(PickLabels, AreThoseOfAFileWhoseNameTheyEnd) {
  const std::vector<JudgedPick> all = {timed("a/pick_06.csv", 0.01), timed("pick_106.csv", 0.01)};
  const LabelledPicks found = compare_with_labels(all, {{"06", true, {}}});
  EXPECT_EQ(found.rows.size(), 1u);
  EXPECT_THAT(found.without_label, ElementsAre("pick_106.csv"));
  EXPECT_EQ(found.response, 0.0);  // one kind alone says nothing of where they part
  EXPECT_THAT(found.to_text(), HasSubstr("pick_106.csv has no label"));
}

}  // namespace
}  // namespace pedicel::discrepancy
