// Tables of measured data as instruments and spreadsheets write them.
#include "plugins/discrepancy/data/experiment_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

class ExperimentTables : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }
  Samples markers(const std::string& text, std::vector<std::string> names = {"m"}) {
    std::vector<Marker> list;
    for (const std::string& name : names) list.push_back({name, {}});
    return read_markers(write(text), list, diagnostics_);
  }
  /// One marker at (1, 2, 3) m after 0.5 s.
  void expect_marker(const std::string& text) {
    const Samples samples = markers(text);
    EXPECT_EQ(diagnostics_.text(), "") << text;
    ASSERT_EQ(samples.size(), 1) << text;
    EXPECT_DOUBLE_EQ(samples.time[0], 0.5) << text;
    for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(samples.value(0, i), i + 1.0) << text;
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "table.csv";
  Diagnostics diagnostics_;
};

TEST_F(ExperimentTables, MarkersInEveryWayOfWriting) {
  expect_marker("time,m.x,m.y,m.z\n0.5,1,2,3\n");
  expect_marker("\xEF\xBB\xBFtime,m.x,m.y,m.z\r\n0.5,1,2,3\r\n");
  expect_marker("time;m.x;m.y;m.z\n0,5;1,0;2;3\n");
  expect_marker("time\tm.x\tm.y\tm.z\n0.5\t1\t2\t3\n");
  expect_marker("Time,M.X,M.Y,M.Z\n0.5,1,2,3\n");
  expect_marker("\"time\",\"m.x\",\"m.y\",\"m.z\"\n\"0.5\",\"1\",\"2\",\"3\"\n");
  expect_marker("# Vicon\n% 100 Hz\ntime,m.z,m.y,m.x,\n0.5,3,2,1,\n,,,\n");
}

TEST_F(ExperimentTables, NamesAndOrdersOfOtherPrograms) {
  expect_marker("time,m_x,m_y,m_z\n0.5,1,2,3\n");
  expect_marker("time,M X,M Y,M Z\n0.5,1,2,3\n");
  expect_marker("time,m:x,m:y,m:z\n0.5,1,2,3\n");
  expect_marker("m.x,m.y,m.z,Time\n1,2,3,0.5\n");
  expect_marker("timestamp,m.x,m.y,m.z\n0.5,1,2,3\n");
  expect_marker("time / ms,m.x / mm,m.y / mm,m.z / mm\n500,1000,2000,3000\n");
  expect_marker("time in s;m_x, mm;m_y, mm;m_z, mm\n0,5;1000;2000;3000\n");
}

TEST_F(ExperimentTables, ColumnsThatCountAreToldAndNotRead) {
  const Samples samples = markers("Frame,time,m.x,m.y,m.z\n7,0,1,2,3\n8,0.5,1,2,3\n");
  EXPECT_THAT(diagnostics_.text(), HasSubstr("table.csv:1:1: notice: column \"Frame\" counts"));
  EXPECT_EQ(diagnostics_.error_count(), 0);
  ASSERT_EQ(samples.size(), 2);
  EXPECT_EQ(samples.time[1], 0.5);
  EXPECT_EQ(samples.value(1, 2), 3.0);
  markers("frame,time,m.x,m.y,m.z\n7,0,1,2,3\n6,0.5,1,2,3\n");
  EXPECT_THAT(diagnostics_.text(), HasSubstr("table.csv:1:1: error: column \"frame\" is unknown"));
}

TEST_F(ExperimentTables, NamesThatFitTwoMarkersAreNotGuessed) {
  markers("time,A_1.x,A_1.y,A_1.z,a1 x,a1 y,a1 z\n0,1,1,1,2,2,2\n", {"A_1", "a-1"});
  EXPECT_THAT(diagnostics_.text(), HasSubstr("columns \"a1 x\", \"a1 y\", \"a1 z\" are unknown and "
                                             "there is no a-1.x, a-1.y, a-1.z, expected"));
  EXPECT_EQ(diagnostics_.error_count(), 1);
}

TEST_F(ExperimentTables, UnitsChangeTheNumbers) {
  expect_marker("time,m.x,m.y,m.z\n(s),(mm),(mm),(mm)\n0.5,1000,2000,3000\n");
  expect_marker("time (ms),m.x (cm),m.y (cm),m.z (cm)\n500,100,200,300\n");
  expect_marker("time_ms,m.x_mm,m.y_mm,m.z_mm\n500,1000,2000,3000\n");
  expect_marker("time_s,m.x_m,m.y_m,m.z_m\n0.5,1,2,3\n");
  const Samples named = markers("time,qx.x (mm),qx.y (mm),qx.z (mm)\n0,1000,0,0\n", {"qx"});
  EXPECT_EQ(named.value(0, 0), 1.0);
  const Samples force =
      read_force(write("time,fx (mN),fy (N),fz (gf)\n0,1000,2,1000\n"), diagnostics_);
  EXPECT_DOUBLE_EQ(force.value(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(force.value(0, 2), 9.80665);
  const DrivenPath path = read_path(
      write("time,x,y,z,qx,qy,qz,qw\ns,mm,mm,mm,1,1,1,1\n0,1000,0,0,0,0,0,1\n"), diagnostics_);
  EXPECT_EQ(diagnostics_.text(), "");
  EXPECT_DOUBLE_EQ(path.position[0].x(), 1.0);
}

TEST_F(ExperimentTables, AUnitThatFitsNothingIsRefused) {
  markers("time,m.x (furlong),m.y,m.z\n0,1,2,3\n");
  EXPECT_THAT(
      diagnostics_.text(),
      HasSubstr("table.csv:1:6: error: column \"m.x (furlong)\" is in \"furlong\", expected "
                "m, cm or mm"));
  Diagnostics fresh;
  diagnostics_ = fresh;
  markers("time (mm),m.x,m.y,m.z\n0,1,2,3\n");
  EXPECT_THAT(diagnostics_.text(), HasSubstr("is in \"mm\", expected s, ms or us"));
  diagnostics_ = fresh;
  markers("time,m.x (mm),m.y,m.z\n(s),(cm),(mm),(mm)\n0,1,2,3\n");
  EXPECT_THAT(diagnostics_.text(), HasSubstr("has \"cm\" below it, expected one unit"));
}

TEST_F(ExperimentTables, MissingMarkersInEveryWay) {
  const Samples samples = markers(
      "time,m.x,m.y,m.z\n0,,,\n1,NaN,NaN,NaN\n2,NA,NA,NA\n3,-,-,-\n4,null,null,null\n5,1,2,3\n");
  EXPECT_EQ(diagnostics_.text(), "");
  ASSERT_EQ(samples.size(), 6);
  for (int r = 0; r < 5; ++r) EXPECT_TRUE(std::isnan(samples.value(r, 0)));
  EXPECT_EQ(samples.value(5, 2), 3.0);
}

TEST_F(ExperimentTables, NamesThatDifferInCapitalsStayApart) {
  const Samples samples = markers("time,M.x,M.y,M.z,m.x,m.y,m.z\n0,1,1,1,2,2,2\n", {"m", "M"});
  EXPECT_EQ(diagnostics_.text(), "");
  EXPECT_EQ(samples.value(0, 0), 2.0);
  EXPECT_EQ(samples.value(0, 3), 1.0);
}

TEST_F(ExperimentTables, TheSameFaultIsSaidOnce) {
  std::string text = "time,m.x,m.y,m.z\n";
  for (int i = 0; i < 200; ++i) text += std::to_string(i) + ",1,,3\n";
  markers(text);
  EXPECT_EQ(diagnostics_.error_count(), 1);
  EXPECT_THAT(diagnostics_.text(),
              HasSubstr("table.csv:2:5: error: m.y is empty where the other axes are not, expected "
                        "all three or none (and 199 more like it, the last in line 201)"));
}

TEST_F(ExperimentTables, EventsToo) {
  const auto events = read_events(
      write("\xEF\xBB\xBFTime (ms);Event;What;By\r\n\"2310\";detached;\"fruit;1\";probe\r\n"),
      diagnostics_);
  EXPECT_EQ(diagnostics_.text(), "");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_DOUBLE_EQ(events[0].time, 2.31);
  EXPECT_EQ(events[0].what, "fruit;1");
}

TEST_F(ExperimentTables, WhatIsNoTextIsNamed) {
  markers("PK\x03\x04 xl/workbook");
  EXPECT_THAT(diagnostics_.text(), HasSubstr("table.csv: error: is an Excel workbook (.xlsx)"));
  EXPECT_EQ(diagnostics_.error_count(), 1);
}

}  // namespace
}  // namespace pedicel::discrepancy
