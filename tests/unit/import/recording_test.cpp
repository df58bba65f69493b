// The tables of motion capture and of point trackers, as their programs lay them out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/import/reading_case.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::point;
using testing::read;

const std::string motive =
    "Format Version,1.23,Take Name,pull,Capture Frame Rate,240.000000,Export Frame Rate,"
    "120.000000,Rotation Type,Quaternion,Length Units,Millimeters,Coordinate Space,Global\n"
    "\n"
    ",Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,"
    "Rigid Body Marker,Rigid Body Marker,Rigid Body Marker,Marker,Marker,Marker\n"
    ",Name,Grip,Grip,Grip,Grip,Grip,Grip,Grip,Grip,P:m1,P:m1,P:m1,P:m1,P:m1,P:m1\n"
    ",ID,1,1,1,1,1,1,1,1,2,2,2,3,3,3\n"
    ",Parent,,,,,,,,,,,,,,\n"
    ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker Error,Position,"
    "Position,Position,Position,Position,Position\n"
    "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,,X,Y,Z,X,Y,Z\n"
    "0,0.000000,0,0,0,1,10,20,30,0.1,91,92,93,1,2,3\n"
    "1,0.008333,0,0,0,1,11,21,31,0.1,91,92,93,,,\n";

TEST(Motive, ReadsWhatWasMeasured) {
  const auto found = read(motive);
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_EQ((*found).program, "OptiTrack Motive CSV");
  EXPECT_THAT((*found).names, ElementsAre("P:m1", "Grip"));
  EXPECT_EQ(point(*found, 0, 0), Vec3(1, 2, 3));
  EXPECT_EQ(point(*found, 1, 1), Vec3(11, 21, 31));
  EXPECT_TRUE(point(*found, 1, 0).array().isNaN().all());
  EXPECT_THAT((*found).time, ElementsAre(0.0, 0.008333));
  EXPECT_EQ((*found).unit.value, 0.001);
  EXPECT_EQ((*found).unit.where.line, 1);
  EXPECT_EQ((*found).rate.value, 120.0);
  EXPECT_FALSE((*found).up.value);
  EXPECT_THAT((*found).remarks, ElementsAre(HasSubstr("1 solved points")));
}

TEST(Motive, ReadsHeadsWithoutLabelsAndATimeCode) {
  const auto found = read(
      "Format Version,1.25,Length Units,Centimeters\n\n,,,Marker,Marker,Marker\n,,,a,a,a\n"
      ",,,Position,Position,Position\nFrame,Time (Seconds),TimeCode,X,Y,Z\n"
      "0,0.5,15:26:46:12.02,-9.5,3,1\n");
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_THAT((*found).names, ElementsAre("a"));
  EXPECT_EQ(point(*found, 0, 0), Vec3(-9.5, 3, 1));
  EXPECT_EQ((*found).unit.value, 0.01);
}

TEST(Motive, RefusesWhatItWouldMisread) {
  EXPECT_THAT(read("Format Version,1.23,Coordinate Space,Local\n").faults,
              HasSubstr("f.csv:1:38: error: Coordinate Space is \"Local\", expected Global"));
  EXPECT_THAT(read("Format Version,1.23,Length Units,Furlongs\n").faults,
              HasSubstr("f.csv:1:34: error: Length Units is \"Furlongs\", expected m, cm or mm"));
  EXPECT_THAT(read("Format Version,1.23\n,Type,Marker\n").faults,
              HasSubstr("no line that begins with Frame"));
  EXPECT_THAT(read(motive + "2,0.016,0,0,0,1,1 mm,1,1,0,1,1,1,1,1,1\n").faults,
              HasSubstr("f.csv:11:17: error: \"1 mm\" is not a finite number"));
  EXPECT_THAT(read(motive + "1,0.0083,0,0,0,1,1,1,1,0,1,1,1,1,1,1\n").faults,
              HasSubstr("the time of sample 3 does not increase"));
}

const std::string qualisys =
    "NO_OF_FRAMES\t2\nNO_OF_CAMERAS\t7\nNO_OF_MARKERS\t2\nFREQUENCY\t100\nNO_OF_ANALOG\t0\n"
    "ANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nTIME_STAMP\t2014-06-17, 08:53:44\t912.5\n"
    "DATA_INCLUDED\t3D\nMARKER_NAMES\troot\ttip\n";

TEST(Qualisys, ReadsRowsWithAndWithoutTime) {
  const auto bare = read(qualisys + "1.5\t2\t3\t4\t5\t6\n0.000\t0.000\t0.000\t7\t8\t9\n");
  ASSERT_TRUE(bare.recording) << bare.faults;
  EXPECT_THAT((*bare).names, ElementsAre("root", "tip"));
  EXPECT_EQ(point(*bare, 0, 0), Vec3(1.5, 2, 3));
  EXPECT_TRUE(point(*bare, 1, 0).array().isNaN().all());
  EXPECT_EQ(point(*bare, 1, 1), Vec3(7, 8, 9));
  EXPECT_EQ((*bare).rate.value, 100.0);
  EXPECT_FALSE((*bare).unit.value);
  EXPECT_THAT((*bare).time, IsEmpty());
  EXPECT_THAT((*bare).remarks, ElementsAre(HasSubstr("1 points at exactly 0, 0, 0")));
  const auto timed = read(qualisys +
                          "TRAJECTORY_TYPES\tMeasured\tMeasured\n"
                          "Frame\tTime\troot X\troot Y\troot Z\ttip X\ttip Y\ttip Z\n"
                          "1\t0,00\t1,5\t2\t3\t4\t5\t6\n2\t0,01\t1,5\t2\t3\t\t\t\n");
  ASSERT_TRUE(timed.recording) << timed.faults;
  EXPECT_THAT((*timed).time, ElementsAre(0.0, 0.01));
  EXPECT_EQ(point(*timed, 1, 0), Vec3(1.5, 2, 3));
  EXPECT_TRUE(point(*timed, 1, 1).array().isNaN().all());
}

// Of later versions, and where a clock outside gave the frames.
TEST(Qualisys, ReadsAVersionAndLeavesAnOutsideClockOpen) {
  const auto found = read(
      "FILE_VERSION\t2.0.0\nNO_OF_FRAMES\t1\nFREQUENCY\tEXT\nEVENT\tpull\t3\t0.5\n"
      "DATA_INCLUDED\t3D\nMARKER_NAMES\ta\n1\t2\t3\n");
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_EQ(point(*found, 0, 0), Vec3(1, 2, 3));
  EXPECT_FALSE((*found).rate.value);
}

TEST(Qualisys, RefusesOtherData) {
  EXPECT_THAT(read("NO_OF_FRAMES\t2\nDATA_INCLUDED\t6D\n").faults,
              HasSubstr("f.csv:2:15: error: DATA_INCLUDED is \"6D\", expected 3D"));
  EXPECT_THAT(read(qualisys + "1\t2\t3\t4\n").faults,
              HasSubstr("f.csv:11:1: error: 4 cells, expected 6 (x, y, z of 2 markers) or 8"));
  EXPECT_THAT(read("NO_OF_FRAMES\t2\n1\t2\t3\n").faults, HasSubstr("rows before MARKER_NAMES"));
  EXPECT_THAT(read(qualisys).faults, HasSubstr("no row of numbers"));
}

TEST(Vicon, ReadsTheTrajectoriesAmongOtherSections) {
  const auto found = read(
      "Devices\n1000\n,,Force\nFrame,Sub Frame,Fx\n,,N\n1,0,3\n\n"
      "Trajectories\n100\n,,Plant:m1,,,Plant:m2,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z\n"
      ",,mm,mm,mm,mm,mm,mm\n5,0,1,2,3,4,5,6\n6,0,,,,7,8,9\n\nModel Outputs\n100\n");
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_EQ((*found).program, "Vicon Nexus CSV");
  EXPECT_THAT((*found).names, ElementsAre("Plant:m1", "Plant:m2"));
  EXPECT_EQ((*found).samples(), 2);
  EXPECT_THAT((*found).frame, ElementsAre(5.0, 6.0));
  EXPECT_EQ((*found).rate.value, 100.0);
  EXPECT_EQ((*found).unit.value, 0.001);
  EXPECT_EQ((*found).unit.where.line, 12);
  EXPECT_TRUE(point(*found, 1, 0).array().isNaN().all());
  EXPECT_EQ(point(*found, 1, 1), Vec3(7, 8, 9));
}

TEST(Vicon, RefusesWhatHasNoTrajectories) {
  EXPECT_THAT(read("Devices\n1000\n,,Force\n").faults, HasSubstr("no section Trajectories"));
  EXPECT_THAT(read("Trajectories\nfast\n").faults,
              HasSubstr("f.csv:2:1: error: \"fast\" is no rate"));
  EXPECT_THAT(
      read("Trajectories\n100\n,,m,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,m\n1,0,1,2,3\n").faults,
      HasSubstr("f.csv:5:9: error: the unit is \"m\", expected one of all markers"));
  EXPECT_THAT(read("Trajectories\n100\n,,m,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n").faults,
              HasSubstr("no samples"));
}

const std::string deeplabcut =
    "scorer,net,net,net,net,net,net\nbodyparts,root,root,root,tip,tip,tip\n"
    "coords,x,y,likelihood,x,y,likelihood\n";

TEST(DeepLabCut, ReadsLikelyPoints) {
  const auto found = read(deeplabcut + "0,10,20,0.99,30,40,0.2\n1,11,21,0.9,31,41,0.7\n");
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_THAT((*found).names, ElementsAre("root", "tip"));
  EXPECT_TRUE((*found).in_pixels);
  EXPECT_EQ(point(*found, 0, 0), Vec3(10, -20, 0));  // up, not down
  EXPECT_TRUE(point(*found, 0, 1).array().isNaN().all());
  EXPECT_EQ(point(*found, 1, 1), Vec3(31, -41, 0));
  EXPECT_FALSE((*found).rate.value);
  EXPECT_THAT((*found).remarks, ElementsAre(HasSubstr("1 points less likely than 0.6")));
}

TEST(DeepLabCut, ReadsIndividualsAndThreeAxes) {
  const auto found = read(
      "scorer,n,n,n,n\nindividuals,a,a,b,b\nbodyparts,tip,tip,tip,tip\ncoords,x,y,x,y\n0,1,2,3,"
      "4\n");
  ASSERT_TRUE(found.recording) << found.faults;
  EXPECT_THAT((*found).names, ElementsAre("a.tip", "b.tip"));
  const auto space = read("scorer,n,n,n\nbodyparts,tip,tip,tip\ncoords,x,y,z\n0,1,2,3\n");
  ASSERT_TRUE(space.recording) << space.faults;
  EXPECT_FALSE((*space).in_pixels);
  EXPECT_EQ(point(*space, 0, 0), Vec3(1, 2, 3));
}

TEST(DeepLabCut, RefusesBrokenHeads) {
  EXPECT_THAT(read("scorer,n,n\nbodyparts,tip,tip\n0,1,2\n").faults,
              HasSubstr("f.csv:3:1: error: the head has no line of coordinates"));
  EXPECT_THAT(read("scorer,n,n\nbodyparts,tip,tip\ncoords,x,w\n0,1,2\n").faults,
              HasSubstr("f.csv:3:10: error: coordinate \"w\" of \"tip\""));
  EXPECT_THAT(read("scorer,n,n\nbodyparts,tip,tip\ncoords,x,x\n0,1,2\n").faults,
              HasSubstr("each at most once"));
  EXPECT_THAT(read("scorer,n,n\nbodyparts,tip,tip\ncoords,x,likelihood\n0,1,2\n").faults,
              HasSubstr("are not whole"));
}

TEST(Tracker, ReadsOneTrackAndSeveral) {
  const auto one = read("mass_A\nt\tx\ty\n0.0\t1.5E-1\t0.2\n4.0E-2\t\t\n");
  ASSERT_TRUE(one.recording) << one.faults;
  EXPECT_EQ((*one).program, "Tracker (OSP) table");
  EXPECT_THAT((*one).names, ElementsAre("mass_A"));
  EXPECT_TRUE((*one).flat);
  EXPECT_EQ(point(*one, 0, 0), Vec3(0.15, 0.2, 0));
  EXPECT_TRUE(point(*one, 1, 0).array().isNaN().all());
  EXPECT_THAT((*one).time, ElementsAre(0.0, 0.04));
  const auto two = read("#multi:\n\tmass A\t\tmass B\t\nt\tx\ty\tx\ty\n0\t1\t2\t3\t4\n");
  ASSERT_TRUE(two.recording) << two.faults;
  EXPECT_THAT((*two).names, ElementsAre("mass A", "mass B"));
  EXPECT_EQ(point(*two, 0, 1), Vec3(3, 4, 0));
  const auto commas = read("mass_A;;\nt;x;y\n0;1,5;2,25\n");
  ASSERT_TRUE(commas.recording) << commas.faults;
  EXPECT_EQ(point(*commas, 0, 0), Vec3(1.5, 2.25, 0));
}

TEST(Recording, TellsTheFormatOrAsksForIt) {
  EXPECT_THAT(read("time,x,y\n0,1,2\n").faults,
              HasSubstr("f.csv:1:1: error: the format cannot be told from the content, expected "
                        "--format with one of: motive, qualisys, vicon, deeplabcut, c3d, tracker"));
  EXPECT_THAT(read("t,x,y\n0,1,2\n", "tracker").faults, "");
  EXPECT_THAT(read("t,x,y\n0,1,2\n", "motive").faults,
              HasSubstr("does not begin with Format Version"));
  EXPECT_THAT(read("t,x,y\n0,1,2\n", "qualisys").faults, HasSubstr("has no line NO_OF_FRAMES"));
  EXPECT_THAT(read("", "").faults, HasSubstr("cannot be told"));
  EXPECT_THAT(read("%PDF-1.4").faults, HasSubstr("a PDF document"));
}

// As a full disk or a stopped export leaves a row.
TEST(Recording, RefusesHalfAPoint) {
  constexpr const char* half = "a point has some of its axes, expected all of them or none";
  EXPECT_THAT(read(motive + "2,0.016,0,0,0,1,1,1,1,0,1,1,1,1,2\n").faults,
              HasSubstr(std::string("f.csv:11:31: error: ") + half));
  EXPECT_THAT(read(qualisys + "1\t2\t3\t4\t\t6\n").faults, HasSubstr(half));
  EXPECT_THAT(read(deeplabcut + "0,10,20,0.99,30\n").faults, HasSubstr(half));
  EXPECT_THAT(read("mass_A\nt\tx\ty\n0.0\t1.5E-1\t\n").faults, HasSubstr(half));
  EXPECT_THAT(read("Trajectories\n100\n,,m,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n1,0,1,2\n").faults,
              HasSubstr(half));
}

TEST(Recording, RefusesANameThatComesTwice) {
  EXPECT_THAT(read("#multi:\n\ta\t\ta\t\nt\tx\ty\tx\ty\n0\t1\t2\t3\t4\n").faults,
              HasSubstr("point \"a\" appears twice"));
}

}  // namespace
}  // namespace pedicel::discrepancy
