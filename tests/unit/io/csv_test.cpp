#include "engine/io/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "engine/core/random.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CsvTest : public testing::Test {
 protected:
  CsvTable read(const std::string& text, const CsvRules& rules = {}) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_csv(path_, rules, diagnostics_);
  }

  /// The file is refused with exactly this complaint, and nothing is loaded.
  void expect_refused(const std::string& text, const std::string& complaint,
                      const CsvRules& rules = {}) {
    const CsvTable table = read(text, rules);
    ASSERT_EQ(diagnostics_.error_count(), 1) << diagnostics_.text();
    EXPECT_EQ(to_string(diagnostics_.all()[0]), path_.string() + ":" + complaint);
    EXPECT_TRUE(table.rows.empty());
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "table.csv";
  Diagnostics diagnostics_;
};

TEST_F(CsvTest, ReadsColumnsRowsAndLines) {
  const CsvTable table = read("# how it was made\r\ntime_s, x_m\r\n\r\n0,1.5e-3\r\n0.5 , -2\r\n");
  EXPECT_FALSE(diagnostics_.has_errors()) << diagnostics_.text();
  EXPECT_THAT(table.columns, ElementsAre("time_s", "x_m"));
  EXPECT_THAT(table.rows, ElementsAre(ElementsAre(0, 1.5e-3), ElementsAre(0.5, -2)));
  EXPECT_THAT(table.lines, ElementsAre(4, 5));
  EXPECT_EQ(table.column("x_m"), 1);
  EXPECT_EQ(table.column("y_m"), -1);
}

TEST_F(CsvTest, EmptyCellsAreMissingValuesOnlyWhereAllowed) {
  const CsvTable table = read("t,x\n0,\n1,nan\n", {.empty_cells = true});
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_TRUE(std::isnan(table.rows[0][1]));
  EXPECT_TRUE(std::isnan(table.rows[1][1]));
}

TEST_F(CsvTest, RefusesEmptyCell) {
  expect_refused("t,x\n0,\n", "2:3: error: x: \"\" is not a finite number");
}
TEST_F(CsvTest, RefusesNan) {
  expect_refused("t,x\n0,nan\n", "2:3: error: x: \"nan\" is not a finite number");
}
TEST_F(CsvTest, RefusesInfinity) {
  expect_refused("t,x\n0,inf\n", "2:3: error: x: \"inf\" is not a finite number");
}
TEST_F(CsvTest, RefusesMissingTimeEvenWhereCellsMayBeEmpty) {
  expect_refused("t,x\nnan,1\n", "2:1: error: t: \"nan\" is not a finite number",
                 {.empty_cells = true});
}
TEST_F(CsvTest, RefusesWords) {
  expect_refused("t,x\n0,wide\n", "2:3: error: x: \"wide\" is not a finite number");
}
TEST_F(CsvTest, RefusesWrongNumberOfCells) {
  expect_refused("t,x\n0,1.5,2\n", "2:1: error: 3 cells, expected 2 as in the header");
}
TEST_F(CsvTest, RefusesTimeThatStands) {
  expect_refused("t,x\n0.5,1\n0.5,2\n",
                 "3:1: error: t 0.5 does not increase, expected more than 0.5");
}
TEST_F(CsvTest, RefusesEmptyFile) {
  expect_refused("", "1:1: error: no header line, expected column names");
}
TEST_F(CsvTest, RefusesHeaderAlone) {
  expect_refused("t,x\n", "1:1: error: no rows, expected at least one row of numbers");
}

TEST_F(CsvTest, TheSameFaultInEveryRowIsSaidOnce) {
  EXPECT_TRUE(read("t,x,y\n0,a,1\n1,b,2\n2\n3\n4,c,5\n").rows.empty());
  EXPECT_EQ(diagnostics_.text(),
            path_.string() +
                ":2:3: error: x: \"a\" is not a finite number (and 2 more like it, "
                "the last in line 6)\n" +
                path_.string() +
                ":4:1: error: 1 cells, expected 3 as in the header (and 1 more "
                "like it, the last in line 5)");
}

TEST_F(CsvTest, AbsentFileIsADiagnostic) {
  read_csv(folder_ / "absent.csv", {}, diagnostics_);
  EXPECT_THAT(diagnostics_.text(), HasSubstr("absent.csv: error: cannot be read"));
}

TEST_F(CsvTest, LinesAreThoseOfTheFile) {
  const CsvTable table = read("\xEF\xBB\xBF# semicolons\r\n\"t\";x\r\n0;1\r\n10; 2\r\n");
  ASSERT_FALSE(diagnostics_.has_errors()) << diagnostics_.text();
  EXPECT_EQ(table.lines[1], 4);
}

TEST_F(CsvTest, WriterAndReaderAgree) {
  Random random(4);
  std::vector<std::vector<double>> rows;
  {
    CsvWriter writer(folder_ / "deep/out.csv", {"time_s", "force_x_N"});
    for (int i = 0; i < 200; ++i) {
      rows.push_back({0.01 * i, random.normal() * std::pow(10.0, random.integer(-12, 12))});
      writer.row(rows.back());
    }
    writer.row(std::vector<double>{2.0, std::numeric_limits<double>::quiet_NaN()});
  }
  const CsvTable back = read_csv(folder_ / "deep/out.csv", {.empty_cells = true}, diagnostics_);
  EXPECT_FALSE(diagnostics_.has_errors()) << diagnostics_.text();
  ASSERT_EQ(back.rows.size(), 201u);
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(back.rows[i][1], rows[i][1], 1e-8 * std::abs(rows[i][1]));
  EXPECT_TRUE(std::isnan(back.rows[200][1]));
}

TEST_F(CsvTest, NamesMayHoldWhatPartsCells) {
  const std::vector<std::string> names = {"time_s", "a,b",    "f,1\"", "\"x\"",  "x\ny",
                                          "a;b;c",  "tab\tx", "p|q",   "plain_N"};
  {
    CsvWriter writer(path_, names);
    writer.row(std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8});
    writer.row(std::vector<double>{1, 1, 2, 3, 4, 5, 6, 7, 8});
  }
  const CsvTable back = read_csv(path_, {}, diagnostics_);
  EXPECT_FALSE(diagnostics_.has_errors()) << diagnostics_.text();
  ASSERT_EQ(back.columns.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(back.columns[i], names[i]);
  ASSERT_EQ(back.rows.size(), 2u);
  EXPECT_EQ(back.rows[1][8], 8.0);
}

TEST_F(CsvTest, FlushedRowsAreThereWhileTheWriterLives) {
  CsvWriter writer(path_, {"time_s"});
  writer.row(std::vector<double>{1.0});
  writer.text_row({"2"});
  writer.flush();
  EXPECT_EQ(read_file(path_), "time_s\n1\n2\n");
}

TEST_F(CsvTest, WriterSaysWhereItCannot) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THAT([&] { CsvWriter(folder_ / "file/out.csv", {"t"}); },
              testing::ThrowsMessage<WriteError>(HasSubstr("out.csv: cannot be written")));
}

TEST(FormatNumber, ShortestOfTheDigits) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(1.0 / 3.0), "0.333333333");
  EXPECT_EQ(format_number(2e7), "20000000");
  EXPECT_EQ(format_number(1.23456e-7, 3), "1.23e-07");
  EXPECT_EQ(format_number(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace pedicel::io
