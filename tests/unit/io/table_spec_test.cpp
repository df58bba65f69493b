#include "engine/io/table_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TableSpecTest : public ::testing::Test {
 protected:
  /// Every value of column `column`; the faults are in `said_`.
  std::vector<double> read(const std::string& text, std::size_t column = 0) {
    std::ofstream(folder_ / "t.csv", std::ios::binary) << text;
    Diagnostics diagnostics;
    SpecTable table(folder_ / "t.csv", spec_, diagnostics);
    std::vector<double> values;
    while (table.next()) values.push_back(table.value(column));
    said_ = diagnostics.text();
    return values;
  }
  std::string fault(const std::string& text) {
    read(text);
    return said_;
  }

  TemporaryFolder folder_;
  TableSpec spec_{.columns = {{"x", Quantity::length}, {"turn", Quantity::angle}},
                  .expected = "time,x,turn"};
  std::string said_;
};

TEST_F(TableSpecTest, ColumnsInAnyOrderAndUnit) {
  EXPECT_THAT(read("Turn (deg);X_mm;time\n180;5;0\n0;-;1\n"), ElementsAre(0.005, testing::IsNan()));
  EXPECT_EQ(said_, "");
  EXPECT_THAT(read("turn,x,time\ndeg,mm,ms\n180,5,0\n", 1), ElementsAre(testing::DoubleEq(M_PI)));
}

TEST_F(TableSpecTest, SaysWhatIsWrongWithTheHeader) {
  EXPECT_THAT(fault("time,x\n0,1\n"),
              HasSubstr("t.csv:1:1: error: no column turn, expected time,x"));
  EXPECT_THAT(
      fault("time,x,y\n0,1,2\n"),
      HasSubstr("t.csv:1:8: error: column \"y\" is unknown and there is no turn, expected"));
  EXPECT_THAT(fault("time,x,turn,X\n0,1,2,3\n"), HasSubstr("1:13: error: column X appears twice"));
  EXPECT_THAT(fault("time,x (kg),turn\n0,1,2\n"), HasSubstr("is in \"kg\", expected m, cm or mm"));
  EXPECT_THAT(fault("x,turn\n1,2\n"), HasSubstr("the first column is \"x\", expected time"));
}

TEST_F(TableSpecTest, SaysWhatIsWrongWithARow) {
  EXPECT_THAT(fault("time,x,turn\n1,1,2\n1,1,2\n"), HasSubstr("t.csv:3:1: error: time 1 does not"));
  EXPECT_THAT(fault("time,x,turn\n-1,1,2\n"), HasSubstr("2:1: error: time -1 is before the trial"));
  EXPECT_THAT(fault("time,x,turn\n,1,2\n"), HasSubstr("2:1: error: time is empty"));
  EXPECT_THAT(fault("time,x,turn\n0,1,two\n"), HasSubstr("t.csv:2:5: error: turn: \"two\" is not"));
  EXPECT_THAT(fault("time,x,turn\n"), HasSubstr("t.csv:1:1: error: no rows, expected"));
  spec_.gaps = false;
  EXPECT_THAT(fault("time,x,turn\n0,,2\n"),
              HasSubstr("2:3: error: x: \"\" is not a finite number"));
}

TEST_F(TableSpecTest, NotEveryColumnIsNeeded) {
  spec_.needed = NeededColumns::any;
  EXPECT_THAT(read("time,turn\n0,2\n"), ElementsAre(testing::IsNan()));
  EXPECT_THAT(fault("time,y\n0,2\n"), HasSubstr("\"y\" is unknown and there is no x, turn"));
  spec_.needed = NeededColumns::none;
  EXPECT_THAT(fault("time,frame\n0,2\n"), HasSubstr("t.csv:1:6: notice: column \"frame\" counts"));
  spec_.needed = NeededColumns::all;
  spec_.needed_first = 1;
  EXPECT_EQ(fault("time,x\n0,2\n"), "");
}

TEST_F(TableSpecTest, AColumnThatIsExpectedCountsNothing) {
  spec_.columns.push_back({"index", Quantity::angle});
  EXPECT_THAT(read("time,x,turn,index\n0,1,1,1\n1,1,1,2\n", 2), ElementsAre(1.0, 2.0));
  EXPECT_EQ(said_, "");
}

TEST_F(TableSpecTest, TimesMayHaveRulesOfTheirOwn) {
  spec_.time.needs_unit = true;
  EXPECT_THAT(fault("time,x,turn\n0,1,2\n"),
              HasSubstr("column \"time\" has no unit, expected time_s"));
  EXPECT_EQ(fault("time_s,x,turn\n0,1,2\n"), "");
  spec_.time = {.increasing = false, .from_zero = false};
  EXPECT_EQ(fault("time,x,turn\n0,1,2\n-1,1,2\n"), "");
  spec_.time.there = false;
  EXPECT_EQ(fault("x,turn\n1,2\n"), "");
  EXPECT_THAT(fault("time,x,turn\n0,1,2\n"), HasSubstr("notice: column \"time\" is not read"));
}

}  // namespace
}  // namespace pedicel::io
