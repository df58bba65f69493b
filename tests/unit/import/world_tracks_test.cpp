// From the file's unit, axes and frames to the world's metres and seconds, and what nobody states.
#include "plugins/discrepancy/import/world_tracks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "engine/core/check.h"
#include "plugins/discrepancy/import/world_frame.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Recording recording() {
  Recording made;
  made.file = "f.csv";
  made.program = "a program";
  made.names = {"a"};
  made.value.resize(2, 3);
  made.value << 1000, 2000, 3000, NAN, NAN, NAN;
  made.frame = {10, 12};
  return made;
}

std::string usage(const std::function<void()>& call) {
  try {
    call();
  } catch (const UsageError& fault) {
    return fault.what();
  }
  return {};
}

TEST(WorldTracks, TakesWhatIsStated) {
  Recording made = recording();
  made.unit = {0.001, {"f.csv", 3, 1}};
  made.rate = {100.0, {}};
  made.up = {'y', {}};
  Statements statements;
  statements.origin = Vec3(0, 0, 0.5);
  ImportNotes notes;
  const WorldTracks tracks = world_tracks(made, statements, notes);
  EXPECT_THAT(notes.missing, IsEmpty());
  EXPECT_NEAR((tracks.value.row(0).transpose() - Vec3(1, -3, 2.5)).norm(), 0.0, 1e-9);
  EXPECT_TRUE(tracks.value.row(1).array().isNaN().all());
  ASSERT_EQ(tracks.time.size(), 2U);
  EXPECT_NEAR(tracks.time[1], 0.02, 1e-12);
  EXPECT_THAT(notes.said, ElementsAre(HasSubstr("rate 100 Hz, as the file states"),
                                      HasSubstr("unit mm, as the file states (line 3)"),
                                      HasSubstr("axis y is up")));
}

TEST(WorldTracks, NamesTheOptionOfEverythingThatIsNotStated) {
  ImportNotes notes;
  world_tracks(recording(), {}, notes);
  EXPECT_THAT(
      notes.missing,
      ElementsAre(HasSubstr("does not state their rate (a program), expected --rate"),
                  HasSubstr("does not state its unit of length (a program), expected --units"),
                  HasSubstr("does not state which axis is up (a program), expected --up x")));
}

TEST(WorldTracks, ThePersonsWordCountsWithAWarning) {
  Recording made = recording();
  made.unit = {0.001, {}};
  made.rate = {100.0, {}};
  Statements statements;
  statements.unit = 0.01;
  statements.rate = 50.0;
  statements.axes = turn_of_axes("x,y,z", "--axes");
  ImportNotes notes;
  const WorldTracks tracks = world_tracks(made, statements, notes);
  EXPECT_NEAR(tracks.value(0, 0), 10.0, 1e-9);
  EXPECT_NEAR(tracks.time[1], 0.04, 1e-12);
  EXPECT_THAT(notes.said, Contains(HasSubstr("warning: unit cm as --units says, though the file "
                                             "states mm")));
  EXPECT_THAT(notes.said, Contains(HasSubstr("warning: rate 50 Hz as --rate says")));
}

TEST(WorldTracks, ScalesAPicture) {
  Recording made = recording();
  made.in_pixels = made.flat = true;
  made.value.row(0) << 740, -380, 0;  // 100 to the right and 100 above the origin's pixel
  Statements statements;
  statements.rate = 100.0;
  ImportNotes lacking;
  world_tracks(made, statements, lacking);
  EXPECT_THAT(lacking.missing,
              ElementsAre(HasSubstr("expected --scale"), HasSubstr("expected --origin-pixel"),
                          HasSubstr("--up")));
  statements.scale = 0.002;
  statements.origin_pixel = Eigen::Vector2d(640, 480);
  statements.axes = turn_of_up('y');
  statements.origin = Vec3(0, 0.03, 0);
  ImportNotes notes;
  const WorldTracks tracks = world_tracks(made, statements, notes);
  EXPECT_THAT(notes.missing, IsEmpty());
  EXPECT_NEAR((tracks.value.row(0).transpose() - Vec3(0.2, 0.03, 0.2)).norm(), 0.0, 1e-9);
  EXPECT_THAT(notes.said, Contains(HasSubstr("the world's y was not measured and stays 0.03 m")));
}

TEST(WorldFrame, ReadsAxesAndRefusesMirrors) {
  const Mat3 turn = turn_of_axes("-x,z,y", "--axes");
  EXPECT_EQ(turn * Vec3(1, 2, 3), Vec3(-1, 3, 2));
  EXPECT_EQ(turn_of_up('x') * Vec3::UnitX(), Vec3::UnitZ());
  EXPECT_EQ(turn_of_up('y') * Vec3::UnitY(), Vec3::UnitZ());
  EXPECT_EQ(turn_of_up('x').determinant(), 1.0);
  EXPECT_THAT(usage([] { turn_of_axes("x,z,y", "--axes"); }),
              HasSubstr("--axes \"x,z,y\": expected right-handed axes: these are a mirror image"));
  for (const char* text : {"x,y", "x,x,z", "x,y,w", "", "x,y,z,x"})
    EXPECT_THAT(usage([&] { turn_of_axes(text, "--axes"); }), HasSubstr("each once")) << text;
  EXPECT_EQ(direction_of_text("-z", "--o"), Vec3(0, 0, -1));
  EXPECT_NEAR((direction_of_text("3,0,4", "--o") - Vec3(0.6, 0, 0.8)).norm(), 0, 1e-12);
  EXPECT_THAT(usage([] { direction_of_text("0,0,0", "--o"); }), HasSubstr("of some length"));
  EXPECT_THAT(usage([] { direction_of_text("1,2", "--o"); }), HasSubstr("an axis (x, -z)"));
  EXPECT_THAT(usage([] { numbers3_of_text("1,2,inf", "--o"); }), HasSubstr("three numbers"));
}

}  // namespace
}  // namespace pedicel::discrepancy
