// Tables of a wrist's force as people write them.
#include "plugins/discrepancy/pick/pick_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class PickTable : public ::testing::Test {
 protected:
  PickRecord read(const std::string& text) {
    io::write_file_atomically(folder_ / "p.csv", text);
    Diagnostics diagnostics;
    notes_ = {};
    const PickRecord record = read_pick_record(folder_ / "p.csv", said_, diagnostics, notes_);
    faults_ = diagnostics.text();
    return record;
  }
  std::string missing() const { return notes_.missing.empty() ? "" : notes_.missing.front(); }

  TemporaryFolder folder_;
  PickColumns said_;
  ImportNotes notes_;
  std::string faults_;
};

TEST_F(PickTable, ReadsAWrench) {
  const PickRecord record = read(
      "time_s,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm\n"
      "0,1,2,3,9,9,9\n0.004,,5,6,9,9,9\n");
  EXPECT_EQ(faults_, "");
  EXPECT_THAT(notes_.missing, IsEmpty());
  EXPECT_THAT(record.time, ElementsAre(0.0, 0.004));
  EXPECT_THAT(record.columns, ElementsAre("force_x_N", "force_y_N", "force_z_N"));
  EXPECT_TRUE(std::isnan(record.force(1, 0)));
  EXPECT_EQ(record.force(1, 2), 6.0);
}

TEST_F(PickTable, KnowsHowAxesAreNamed) {
  for (const char* names :
       {"Fx (N);Fy (N);Fz (N)", "wrench.force.x [N];wrench.force.y [N];force z (N)",
        "ft/wrench/force/x (N);ft/wrench/force/y (N);ft/wrench/force/z (N)", "f_x_N;f_y_N;f_z_N",
        "Force_X_mN;Force_Y_mN;Force_Z_mN"}) {
    const PickRecord record = read("Time (ms);" + std::string(names) + "\n0;1;2;3\n4;1,5;2;3\n");
    EXPECT_EQ(faults_, "") << names;
    EXPECT_EQ(missing(), "") << names;
    EXPECT_EQ(record.force.cols(), 3) << names;
    EXPECT_THAT(record.time, ElementsAre(0.0, ::testing::DoubleNear(0.004, 1e-12))) << names;
  }
  EXPECT_EQ(read("time_s,Load (gf)\n0,1000\n1,1000\n").force(0, 0), 9.80665);
}

TEST_F(PickTable, GuessesNoUnit) {
  read("t,fx,fy,fz\n0,1,2,3\n4,1,2,3\n");
  EXPECT_EQ(faults_, "");
  EXPECT_THAT(missing(), HasSubstr("column \"t\" has no unit, expected --time-unit with "));
  EXPECT_THAT(notes_.missing.back(),
              HasSubstr("column \"fx\" has no unit, expected --force-unit with "));
  said_.time_unit = 1e-3;
  said_.force_unit = 1e-3;
  const PickRecord record = read("t,fx,fy,fz\n0,1,2,3\n4,1,2,3\n");
  EXPECT_EQ(missing(), "");
  EXPECT_EQ(record.force(0, 1), 2e-3);
  EXPECT_EQ(record.time[1], 4e-3);
}

TEST_F(PickTable, GuessesNoColumn) {
  read("time_s,left_force_x_N,right_force_x_N\n0,1,2\n1,1,2\n");
  EXPECT_THAT(missing(), HasSubstr("more than one sensor's force, expected --force-column"));
  read("time_s,zug\n0,1\n1,1\n");
  EXPECT_THAT(missing(), HasSubstr("no column is a force, expected --force-column"));
  said_.force = {"zug"};
  said_.force_unit = 1.0;
  EXPECT_EQ(read("time_s,zug\n0,1\n1,1\n").columns.front(), "zug");
  said_.force = {"schub"};
  read("time_s,zug\n0,1\n1,1\n");
  EXPECT_THAT(
      faults_,
      HasSubstr("p.csv:1:1: error: no column \"schub\", expected one of: \"time_s\", \"zug\""));
  said_ = {};
  read("zeit_s,fx_N\n0,1\n1,1\n");
  EXPECT_THAT(faults_,
              HasSubstr("no column is the time, expected one named time or --time-column"));
  said_.time = "zeit_s";
  EXPECT_EQ(read("zeit_s,fx_N\n0,1\n1,1\n").time.size(), 2u);
}

TEST_F(PickTable, TellsFaultsWithTheirPlace) {
  read("time_s,fx_N\n0,1\n1,much\n");
  EXPECT_THAT(faults_, HasSubstr("p.csv:3:3: error: \"much\" is not a finite number"));
  read("time_s,fx_N\n0,1\n0,2\n");
  EXPECT_THAT(faults_, HasSubstr("p.csv:3:1: error: time does not increase here"));
  read("time_s,fx_N\n0,1\n,2\n");
  EXPECT_THAT(faults_, HasSubstr("p.csv:3:1: error: time does not increase here"));
  read("time_s,fx_mm\n0,1\n1,2\n");
  EXPECT_THAT(missing() + faults_, HasSubstr("no column is a force"));
  read("time_s,fx (mm)\n0,1\n1,2\n");
  EXPECT_THAT(faults_, HasSubstr("p.csv:1:8: error: column \"fx (mm)\" is in \"mm\", expected N"));
  read("time_s,fx_N\n");
  EXPECT_THAT(faults_, HasSubstr("error"));
  read("");
  EXPECT_THAT(faults_, HasSubstr("error"));
}

}  // namespace
}  // namespace pedicel::discrepancy
