// Numbers as people and their programs write them.
#include "engine/io/number_text.h"

#include <gtest/gtest.h>

namespace pedicel::io {
namespace {

using Kind = NumberText::Kind;

struct Read {
  const char* text;
  double value;
};

TEST(NumberText, ReadsEveryWayOfWritingANumber) {
  for (const Read& read : {Read{"1", 1},
                           {"+1.5", 1.5},
                           {".5", 0.5},
                           {"5.", 5},
                           {"-.5", -0.5},
                           {"1e-3", 1e-3},
                           {"1E-3", 1e-3},
                           {"1e+3", 1e3},
                           {"1d-3", 1e-3},
                           {"1.5D+02", 150},
                           {"\xE2\x88\x92"
                            "2",
                            -2},
                           {"\xE2\x80\x93"
                            "2.5",
                            -2.5},
                           {"007", 7},
                           {"-0", 0},
                           {"0.1", 0.1},
                           {"1e-400", 0},
                           {"1,234.5", 1234.5},
                           {"1,234,567", 1234567},
                           {"1'234.5", 1234.5},
                           {"1\xE2\x80\xAF"
                            "234",
                            1234},
                           {"12\xC2\xA0"
                            "345.5",
                            12345.5}}) {
    const NumberText found = number_of(read.text);
    EXPECT_EQ(found.kind, Kind::number) << read.text;
    EXPECT_EQ(found.value, read.value) << read.text;
  }
}

TEST(NumberText, ReadsDecimalCommas) {
  for (const Read& read : {Read{"0,5", 0.5},
                           {"-1,25e-3", -1.25e-3},
                           {",5", 0.5},
                           {"5,", 5},
                           {"1.234,5", 1234.5},
                           {"1.234.567", 1234567},
                           {"12", 12},
                           {"1\xC2\xA0"
                            "234,5",
                            1234.5}}) {
    const NumberText found = number_of(read.text, {','});
    EXPECT_EQ(found.kind, Kind::number) << read.text;
    EXPECT_EQ(found.value, read.value) << read.text;
  }
  EXPECT_EQ(number_of("1.234", {','}).kind, Kind::unclear);
  EXPECT_EQ(number_of("0.5", {','}).kind, Kind::unclear);
}

TEST(NumberText, KnowsMissingValues) {
  for (const char* text :
       {"",        "NA",      "N/A",    "n/a",  "#N/A", "NaN", "nan",         "NAN",
        "-nan",    "null",    "NULL",   "None", "-",    "--",  ".",           "?",
        "missing", "-1.#IND", "1.#IND", "n.a.", "N.A.", "*",   "\xE2\x80\x94"})
    EXPECT_EQ(number_of(text).kind, Kind::missing) << text;
}

TEST(NumberText, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"inf", "-inf", "+Inf", "Infinity", "1.#INF", "1e999", "-1e400"})
    EXPECT_EQ(number_of(text).kind, Kind::infinite) << text;
  for (const char* text : {"a", "1.2.3", "1,5", "12,34", "0x1A", "1 2", "1e", "e5", "+", "1e5.5",
                           "5%", "--5", "1_000", "0,123.4", "1'23", "#DIV/0!", "\xFF"})
    EXPECT_EQ(number_of(text).kind, Kind::other) << text;
}

TEST(NumberText, SaysWhatToWriteInstead) {
  EXPECT_EQ(why_no_number("abc"), "is not a finite number");
  EXPECT_EQ(why_no_number("12:30:01.5"),
            "is not a finite number but a date or a time of day, expected seconds");
  EXPECT_EQ(why_no_number("2026-03-01T10:00:00Z"),
            "is not a finite number but a date or a time of day, expected seconds");
  EXPECT_EQ(why_no_number("1.5 mm"),
            "is not a finite number, expected the number alone (a unit stands in the header: "
            "\"x (mm)\")");
}

TEST(NumberText, TellsWhatACommaCanBe) {
  EXPECT_EQ(comma_use("0,5"), CommaUse::decimal);
  EXPECT_EQ(comma_use("0,123"), CommaUse::decimal);
  EXPECT_EQ(comma_use("1,5e3"), CommaUse::decimal);
  EXPECT_EQ(comma_use("1.234,5"), CommaUse::decimal);
  EXPECT_EQ(comma_use("1,234"), CommaUse::either);
  EXPECT_EQ(comma_use("1,234,567"), CommaUse::groups);
  EXPECT_EQ(comma_use("1,234.5"), CommaUse::groups);
  EXPECT_EQ(comma_use("a,b"), CommaUse::none);
  EXPECT_EQ(comma_use("5"), CommaUse::none);
}

}  // namespace
}  // namespace pedicel::io
