// Tables as people have them: each is read as what it means, or refused with what was found.
#include "engine/io/table_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/io/text_file.h"

namespace pedicel::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// What the reader makes of a text.
struct Outcome {
  std::vector<std::string> columns, units;
  std::vector<std::vector<double>> rows;
  std::string faults, notices;
};

Outcome read(const std::string& bytes) {
  Diagnostics diagnostics;
  Outcome outcome;
  try {
    const std::string text = text_of_bytes(bytes, "f");
    TableText table(text, "f", diagnostics);
    for (const TableColumn& column : table.columns()) {
      outcome.columns.push_back(column.name);
      outcome.units.push_back(column.unit);
    }
    while (table.next()) {
      outcome.rows.emplace_back();
      for (std::size_t i = 0; i < table.columns().size(); ++i)
        outcome.rows.back().push_back(table.number(i, true));
    }
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  for (const Diagnostic& one : diagnostics.all()) {
    std::string& said = one.severity == Severity::notice ? outcome.notices : outcome.faults;
    said += (said.empty() ? "" : "\n") + to_string(one);
  }
  return outcome;
}

/// Reads as the columns t and x with the rows (0, 0.5) and (1, -2).
void expect_plain(const std::string& bytes) {
  const Outcome outcome = read(bytes);
  EXPECT_EQ(outcome.faults, "") << bytes;
  EXPECT_THAT(outcome.columns, ElementsAre("t", "x")) << bytes;
  EXPECT_THAT(outcome.rows, ElementsAre(ElementsAre(0, 0.5), ElementsAre(1, -2))) << bytes;
}

TEST(TableText, ReadsEverySeparator) {
  expect_plain("t,x\n0,0.5\n1,-2\n");
  expect_plain("t;x\n0;0.5\n1;-2\n");
  expect_plain("t\tx\n0\t0.5\n1\t-2\n");
  expect_plain("t|x\n0|0.5\n1|-2\n");
  expect_plain("t x\n0 0.5\n1 -2\n");
  expect_plain("  t    x\n  0  0.5\n  1   -2\n");
  expect_plain("t x\n0\t0.5\n1 \t-2\n");
  expect_plain("sep=;\r\nt;x\r\n0;0,5\r\n1;-2\r\n");
}

TEST(TableText, ReadsDecimalCommasWhereNoCommaPartsTheCells) {
  expect_plain("t;x\n0;0,5\n1;-2\n");
  expect_plain("t\tx\n0\t0,5\n1\t-2,000\n");
  expect_plain("t,x\n\"0\",\"0,5\"\n\"1\",\"-2\"\n");
}

TEST(TableText, ReadsLineEndsOfEverySystem) {
  expect_plain("t,x\r\n0,0.5\r\n1,-2\r\n");
  expect_plain("t,x\r0,0.5\r1,-2\r");
  expect_plain("t,x\n0,0.5\r\n1,-2");
  expect_plain("\xEF\xBB\xBFt,x\n0,0.5\n1,-2\n");
}

TEST(TableText, PassesOverWhatSaysNothing) {
  expect_plain("# made by hand, in May\n\nt,x\n\n% note\n0,0.5\n   \n1,-2\n\n");
  expect_plain("t,x,\n0,0.5,\n1,-2,\n");
  expect_plain("t,x\n0,0.5,,,\n1,-2,\n");
  expect_plain("t,x\n0,0.5\n1,-2\n,\n,\n");
  expect_plain("\"# a, comment that Excel quoted\",\nt,x\n0,0.5\n1,-2\n");
  expect_plain(" t , x \n 0 , 0.5 \n 1 , -2 \n");
  expect_plain("// made by hand, in May; and after\nt,x\n0,0.5\n1,-2\n");
  expect_plain("; made by hand\nt;x\n0;0.5\n1;-2\n");
  expect_plain(
      "t,x\n0,\xE2\x80\x89"
      "0.5\xE2\x80\xAF\n1,-2\xC2\xA0\n");
  expect_plain("t,\"x\n\"\n0,0.5\n1,-2\n");
}

TEST(TableText, ReadsQuotes) {
  expect_plain("\"t\",\"x\"\n\"0\",\"0.5\"\n\"1\",\"-2\"\n");
  expect_plain("'t','x'\n'0','0.5'\n'1','-2'\n");
  EXPECT_THAT(read("\"t\",\"x, \"\"across\"\"\"\n0,1\n").columns,
              ElementsAre("t", "x, \"across\""));
  const Outcome lines = read("t,\"x\n(mm)\"\n0,a\n");
  EXPECT_THAT(lines.columns, ElementsAre("t", "x\n(mm)"));
  EXPECT_EQ(lines.faults, "f:3:3: error: x\\n(mm): \"a\" is not a finite number");
  EXPECT_THAT(read("t,x\n0,\"1\n2,3\n").faults, HasSubstr("f:2:1: error: a quote opens"));
}

TEST(TableText, ReadsNamesFromACommentAboveBareNumbers) {
  expect_plain("# t x\n0.0 0.5\n1.0 -2\n");
  expect_plain("%t,x\n0,0.5\n1,-2\n");
  EXPECT_EQ(read("0,0.5\n1,-2\n").faults,
            "f:1:1: error: no header line, expected column names before the first numbers");
  EXPECT_THAT(read("# three names here\n0,1\n").faults, HasSubstr("no header line"));
}

TEST(TableText, PassesOverNumbersOfRows) {
  expect_plain(",t,x\n0,0,0.5\n1,1,-2\n");                      // pandas
  expect_plain("\"\",\"t\",\"x\"\n\"1\",0,0.5\n\"2\",1,-2\n");  // R: write.csv
  expect_plain("\"t\" \"x\"\n\"1\" 0 0.5\n\"2\" 1 -2\n");       // R: write.table
  expect_plain("Unnamed: 0;t;x\n1;0;0,5\n2;1;-2\n");
  expect_plain("| t | x |\n|---|--:|\n| 0 | 0.5 |\n| 1 | -2 |\n");  // drawn with |
  // What does not count is no number of a row, and a name is a column's.
  EXPECT_THAT(read(",t,x\n0,0,0.5\n2,1,-2\n").columns, ElementsAre("", "t", "x"));
  EXPECT_THAT(read("n,t,x\n0,0,0.5\n1,1,-2\n").columns, ElementsAre("n", "t", "x"));
  EXPECT_THAT(read("t,x\n0,0,5\n1,5,2\n").faults, HasSubstr("3 cells, expected 2"));
  const Outcome few = read(",t,x\n0,0\n1,1\n");
  EXPECT_EQ(few.notices,
            "f:1:1: notice: the first column has no name and counts the rows: it is not read");
  EXPECT_EQ(few.faults,
            "f:2:1: error: 2 cells, expected 3 as in the header (and 1 more like it, the last in "
            "line 3)");
  EXPECT_THAT(read(",t,x\n0,0,1\n1,1,a\n").faults, HasSubstr("f:3:5: error: x: \"a\" is not"));
}

TEST(TableText, SaysOneFaultOnceInHoweverManyColumns) {
  EXPECT_EQ(read("t,x,y\n0,1 m,2 m\n1,3 m,4 m\n").faults,
            "f:2:3: error: x: \"1 m\" is not a finite number, expected the number alone (a unit "
            "stands in the header: \"x (mm)\") (and 3 more like it, the last in line 3)");
  EXPECT_EQ(read("t,x\n0,1\nt,x\n1,2\n").faults,
            "f:3:1: error: the names of the columns again, expected one table in a file");
  EXPECT_THAT(read("t,,x\n0,a,2\n").faults, HasSubstr("f:2:3: error: column 2: \"a\""));
}

TEST(TableText, NamesThePrograms) {
  EXPECT_THAT(read("Trajectories\n100\n,,P:m1,,\nFrame,Sub Frame,X,Y,Z\n").faults,
              HasSubstr("f: error: is a table as Vicon Nexus writes it"));
  EXPECT_THAT(read("Format Version,1.23,Take Name,a\n").faults, HasSubstr("OptiTrack Motive"));
  EXPECT_THAT(read("NO_OF_FRAMES\t20\nNO_OF_MARKERS\t9\n").faults, HasSubstr("Qualisys"));
  EXPECT_THAT(read("FILE_VERSION\t2.0.0\nNO_OF_FRAMES\t20\n").faults, HasSubstr("Qualisys"));
  EXPECT_THAT(read("NO_OF_FRAMES\t20\n").faults, HasSubstr("pedicel import makes an experiment"));
  EXPECT_THAT(read("PathFileType\t4\t(X/Y/Z)\n").faults,
              AllOf(HasSubstr("OpenSim"), Not(HasSubstr("pedicel import"))));
  EXPECT_THAT(read("scorer,a,a\nbodyparts,m,m\n").faults, HasSubstr("DeepLabCut"));
  EXPECT_EQ(read("scorers,x\n0,1\n").faults, "");
}

TEST(TableText, ReadsARowOfUnits) {
  const Outcome instron = read("Time,Extension,Load\n(s),(mm),(N)\n0,1,2\n");
  EXPECT_THAT(instron.columns, ElementsAre("Time", "Extension", "Load"));
  EXPECT_THAT(instron.units, ElementsAre("s", "mm", "N"));
  EXPECT_THAT(instron.rows, ElementsAre(ElementsAre(0, 1, 2)));
  EXPECT_THAT(read("\"t\";\"x\"\n\"[s]\";\"[furlong]\"\n0;1\n").units, ElementsAre("s", "furlong"));
  EXPECT_THAT(read("t,x,n\ns,mm,-\n0,1,2\n").units, ElementsAre("s", "mm", ""));
  EXPECT_THAT(read("t,x\n-,-\n0,1\n").units, ElementsAre("", ""));  // missing values
}

TEST(TableText, MissingValuesAreNoNumbers) {
  const Outcome gaps = read("t,x\n0,\n1,NA\n2,#N/A\n3,null\n4,-\n");
  EXPECT_EQ(gaps.faults, "");
  ASSERT_EQ(gaps.rows.size(), 5u);
  for (const auto& row : gaps.rows) EXPECT_TRUE(std::isnan(row[1]));
  EXPECT_EQ(read("x,t\n#N/A,1\n").rows.size(), 1u);  // no comment
}

TEST(TableText, GuessesNothing) {
  EXPECT_EQ(read("t;x\n0;1,234\n1;5,678\n").faults,
            "f:2:3: error: \"1,234\" may be a fraction or have groups of three digits, and no "
            "other number tells: expected a decimal point and no groups");
  EXPECT_EQ(read("t;x\n0;1,234\n1;0,5\n").rows[0][1], 1.234);
  EXPECT_EQ(read("t;x\n0;1,234\n1;0.5\n").rows[0][1], 1234);
  EXPECT_THAT(
      read("t;x\n0;0,5\n1;0.5\n").faults,
      HasSubstr("f:2:3: error: \"0,5\" has a decimal comma and \"0.5\" in line 3 has none"));
  EXPECT_THAT(read("t;x\n0;0,5\n1;1.234\n").faults, HasSubstr("f:3:3: error: x: \"1.234\" may be"));
  EXPECT_THAT(read("t,x\n0,5,1,5\n").faults,
              HasSubstr("f:2:1: error: 4 cells, expected 2 as in the header (decimal commas?"));
  EXPECT_THAT(read("t,x,y\n0;1;2\n").faults,
              HasSubstr("f:2:1: error: the row is parted by semicolons, the header by commas"));
  EXPECT_THAT(read("t\n0;1;2\n").faults, HasSubstr("the row has 3 cells parted by semicolons"));
  EXPECT_THAT(read("a;b,c\n").faults, HasSubstr("the header has commas and semicolons"));
}

TEST(TableText, AHeaderMayHoldOtherMarks) {
  const Outcome outcome = read("t;x (m, world);y\n0;1,5;2\n");
  EXPECT_EQ(outcome.faults, "");
  EXPECT_THAT(outcome.columns, ElementsAre("t", "x (m, world)", "y"));
  EXPECT_THAT(outcome.rows, ElementsAre(ElementsAre(0, 1.5, 2)));
}

TEST(TableText, CountsBeforeItFillsTheMemory) {
  std::string wide = "c";
  for (int i = 0; i < 1000000; ++i) wide += ",c";
  EXPECT_EQ(read(wide + "\n").faults, "f:1:1: error: 1000001 columns, expected at most 10000");
  std::string row = "t,x\n0,1\n";
  for (int i = 0; i < 1000000; ++i) row += "1.5,";
  EXPECT_EQ(read(row + "1\n").faults, "f:3:1: error: 1000001 cells, expected 2 as in the header");
}

}  // namespace
}  // namespace pedicel::io
