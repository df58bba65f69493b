// C3D files of three kinds of computer, with integers and with reals, whole and broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/import/c3d_file.h"
#include "tests/unit/import/reading_case.h"

namespace pedicel::discrepancy {
namespace {

using testing::C3dFile;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::point;
using testing::read;

class C3dOfEveryKind : public ::testing::TestWithParam<std::tuple<C3dProcessor, bool>> {};

TEST_P(C3dOfEveryKind, ReadsPointsRateAndUnit) {
  C3dFile file;
  std::tie(file.processor, file.reals) = GetParam();
  file.analog = 3;
  file.up = "+Z";
  const auto found = read(file.bytes());
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_EQ((*found).program, "C3D");
  EXPECT_THAT((*found).names, ElementsAre("root", "tip"));
  ASSERT_EQ((*found).samples(), 2);
  EXPECT_EQ(point(*found, 0, 0), Vec3(1.5, -2, 3));
  EXPECT_EQ(point(*found, 0, 1), Vec3(4, 5, 6));
  EXPECT_TRUE(point(*found, 1, 0).array().isNaN().all());
  EXPECT_EQ(point(*found, 1, 1), Vec3(7, 8.5, -9));
  EXPECT_EQ((*found).rate.value, 100.0);
  EXPECT_EQ((*found).unit.value, 0.001);
  EXPECT_EQ((*found).up.value, 'z');
  EXPECT_THAT((*found).remarks, ElementsAre(HasSubstr("3 analog samples a frame are not read")));
}

INSTANTIATE_TEST_SUITE_P(Processors, C3dOfEveryKind,
                         ::testing::Combine(::testing::Values(C3dProcessor::intel,
                                                              C3dProcessor::dec,
                                                              C3dProcessor::mips),
                                            ::testing::Bool()));

TEST(C3d, LeavesOpenWhatItDoesNotState) {
  C3dFile file;
  file.unit.clear();
  file.labels = {"", "tip"};
  const auto found = read(file.bytes());
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_FALSE((*found).unit.value);
  EXPECT_FALSE((*found).up.value);
  EXPECT_THAT((*found).names, ElementsAre("point_1", "tip"));
}

// 70,000 frames: the head's 16 bits cannot count them.
TEST(C3d, CountsLongRecordings) {
  C3dFile file;
  file.reals = false;
  file.labels = {"tip"};
  file.frames.assign(70000, {Vec3(1, 2, 3)});
  file.frames.back() = {Vec3(4, 5, 6)};
  file.trial = {{"ACTUAL_START_FIELD", {1, 0}}, {"ACTUAL_END_FIELD", {70000 & 0xFFFF, 1}}};
  const auto found = read(file.bytes());
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_EQ((*found).samples(), 70000);
  EXPECT_EQ(point(*found, 69999, 0), Vec3(4, 5, 6));
}

TEST(C3d, RefusesACutFileOfEveryLength) {
  const std::string whole = C3dFile().bytes();
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    const auto found = read(whole.substr(0, length), "c3d");
    EXPECT_FALSE(found.recording) << length;
    EXPECT_THAT(found.faults, HasSubstr("f.csv: error: ")) << length;
  }
  EXPECT_THAT(read(whole.substr(0, whole.size() - 1)).faults,
              HasSubstr("the head counts 2 frames, and there are 1 whole ones"));
  EXPECT_THAT(read(whole.substr(0, 600)).faults, HasSubstr(" error: "));
}

TEST(C3d, RefusesHostileHeads) {
  const std::string whole = C3dFile().bytes();
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string changed = whole;
    return read(changed.replace(at, bytes.size(), bytes)).faults;
  };
  EXPECT_THAT(with(2, "\xFF\xFF"), HasSubstr("whole ones"));  // 65535 points
  EXPECT_THAT(with(2, std::string("\0\0", 2)), HasSubstr("counts 0 points"));
  EXPECT_THAT(with(8, "\xFF\xFF"), HasSubstr("the head counts 65535 frames"));
  EXPECT_THAT(with(16, "\xFF\xFF"), HasSubstr("the data begin in block 65535"));
  EXPECT_THAT(with(16, std::string("\0\0", 2)), HasSubstr("the data begin in block 0"));
  EXPECT_THAT(with(512 + 3, "\x57"), HasSubstr("processor type 87 is unknown"));
  EXPECT_THAT(with(0, "\xFF"), HasSubstr("ends before its parameters"));
}

TEST(C3d, RefusesAScaleOfNothing) {
  C3dFile file;
  file.frames = {{Vec3::Zero(), Vec3::Zero()}};
  for (const double scale : {0.0, HUGE_VAL}) {
    file.scale = scale;
    EXPECT_THAT(read(file.bytes()).faults, HasSubstr("the scale of the points is"));
  }
}

TEST(C3d, RefusesAParameterBeyondTheFile) {
  std::string whole = C3dFile().bytes();
  const std::size_t labels = whole.find("LABELS");
  ASSERT_NE(labels, std::string::npos);
  whole[labels + 6 + 2 + 2] = '\xFF';  // 255 letters
  whole[labels + 6 + 2 + 3] = '\xFF';  // of 255 labels
  EXPECT_THAT(read(whole).faults, HasSubstr("is broken"));
}

}  // namespace
}  // namespace pedicel::discrepancy
