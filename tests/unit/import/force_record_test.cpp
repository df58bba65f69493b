// Tables of testing machines and of force sensors.
#include "plugins/discrepancy/import/force_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/import/world_frame.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ForceTable : public ::testing::Test {
 protected:
  ForceRecord read(const std::string& text) {
    io::write_file_atomically(folder_ / "f.csv", text);
    Diagnostics diagnostics;
    notes_ = {};
    const ForceRecord record = read_force_record(folder_ / "f.csv", said_, diagnostics, notes_);
    faults_ = diagnostics.text();
    return record;
  }

  TemporaryFolder folder_;
  ForceStatements said_;
  ImportNotes notes_;
  std::string faults_;
};

TEST_F(ForceTable, ReadsTwoRowHeads) {
  said_.direction = Vec3(0, 0, -1);
  said_.extension = "Extension";
  const ForceRecord record = read("Time,Extension,Load\n(s),(mm),(mN)\n0,1.5,0\n0.5,2,250\n");
  EXPECT_EQ(faults_, "");
  EXPECT_THAT(notes_.missing, IsEmpty());
  EXPECT_THAT(record.time, ElementsAre(0.0, 0.5));
  EXPECT_NEAR((record.value.row(1).transpose() - Vec3(0, 0, -0.25)).norm(), 0.0, 1e-12);
  EXPECT_THAT(record.extension, ElementsAre(0.0015, 0.002));
}

// A testing machine writes about the test before it comes to the table.
TEST_F(ForceTable, PassesOverLinesAboutTheTest) {
  said_.direction = Vec3::UnitX();
  const ForceRecord record = read(
      "Specimen label : stem 3\nResults Table 1\n,Maximum Load,Break\n,(N),\n1,0.31,no\n\n"
      "Time,Extension,Load\n(s),(mm),(N)\n\"0.0\",\"1.5\",\"0.1\"\n\"0.5\",\"2\",\"0.2\"\n");
  EXPECT_EQ(faults_, "");
  EXPECT_THAT(record.time, ElementsAre(0.0, 0.5));
  EXPECT_NEAR(record.value(1, 0), 0.2, 1e-12);
  read("a test\n\nTime (s),Load (N)\n0,high\n");
  EXPECT_THAT(faults_, HasSubstr("f.csv:4:3: error: \"high\" is not a finite number"));
}

TEST_F(ForceTable, TurnsASensorsAxes) {
  said_.axes = turn_of_axes("x,-z,y", "--force-axes");
  const ForceRecord record = read("time_s;fx (N);fy (N);fz (N)\n0;1,5;2;3\n1;;;\n");
  EXPECT_EQ(faults_, "");
  EXPECT_THAT(notes_.missing, IsEmpty());
  ASSERT_EQ(record.value.rows(), 2);
  EXPECT_EQ(Vec3(record.value.row(0).transpose()), Vec3(1.5, -3, 2));
  EXPECT_TRUE(record.value.row(1).array().isNaN().all());
}

TEST_F(ForceTable, AsksForWhatNobodyStates) {
  read("Time,Load\n0,1\n");
  EXPECT_THAT(notes_.missing,
              ElementsAre(HasSubstr("column \"Time\" has no unit, expected --time-unit"),
                          HasSubstr("\"Load\" has no unit, expected --force-unit"),
                          HasSubstr("expected --force-direction")));
  read("Time (s),A (N),B (N)\n0,1,2\n");
  EXPECT_THAT(notes_.missing,
              ElementsAre(HasSubstr("more than one column is a force, expected --force-column with "
                                    "one of: \"Time (s)\", \"A (N)\", \"B (N)\"")));
  read("Time (s),fx (N),fy (N),fz (N)\n0,1,2,3\n");
  EXPECT_THAT(notes_.missing, ElementsAre(HasSubstr("expected --force-axes")));
}

TEST_F(ForceTable, TakesThePersonsWord) {
  said_.direction = Vec3::UnitX();
  said_.column = "B";
  said_.unit = 9.80665e-3;
  said_.time_unit = 1e-3;
  const ForceRecord record = read("Time,A,B\n0,1,2\n10,1,100\n");
  EXPECT_EQ(faults_, "");
  EXPECT_THAT(record.time, ElementsAre(0.0, 0.01));
  EXPECT_NEAR(record.value(1, 0), 0.980665, 1e-12);
}

TEST_F(ForceTable, RefusesWithAPlace) {
  said_.direction = Vec3::UnitX();
  read("Load (N)\n1\n");
  EXPECT_THAT(faults_, HasSubstr("f.csv:1:1: error: no column is the time"));
  read("Time (s),Load (mm)\n0,1\n");
  EXPECT_THAT(notes_.missing, ElementsAre(HasSubstr("no column is a force")));
  read("Time (s),Load (N)\n0,1\n0,2\n");
  EXPECT_THAT(faults_, HasSubstr("f.csv:3:1: error: time does not increase here"));
  said_.column = "C";
  read("Time (s),Load (N)\n0,1\n");
  EXPECT_THAT(faults_, HasSubstr("no column \"C\", expected one of: \"Time (s)\", \"Load (N)\""));
}

}  // namespace
}  // namespace pedicel::discrepancy
