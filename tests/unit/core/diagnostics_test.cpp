#include "engine/core/diagnostics.h"

#include <gtest/gtest.h>

#include "engine/core/check.h"

namespace pedicel {
namespace {

TEST(Diagnostics, LinesHaveTheFixedForm) {
  EXPECT_EQ(to_string({Severity::error, {"a.yaml", 3, 7}, "x is 1, expected 2"}),
            "a.yaml:3:7: error: x is 1, expected 2");
  EXPECT_EQ(to_string({Severity::warning, {"a.yaml", 3, 7}, "odd"}), "a.yaml:3:7: warning: odd");
  EXPECT_EQ(to_string({Severity::error, {"a.yaml"}, "absent"}), "a.yaml: error: absent");
}

TEST(Diagnostics, NoticesAreNoFaults) {
  Diagnostics diagnostics;
  diagnostics.notice({"tree.mtg"}, "4.31 m tall, 812 nodes");
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.text(), "tree.mtg: notice: 4.31 m tall, 812 nodes");
}

TEST(Diagnostics, CollectsInOrderAndCountsErrorsOnly) {
  Diagnostics diagnostics;
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.warning({"f", 1, 1}, "first");
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.error({"f", 2, 1}, "second");
  diagnostics.error({"f", 1, 5}, "third");
  EXPECT_EQ(diagnostics.error_count(), 2);
  EXPECT_EQ(diagnostics.text(), "f:1:1: warning: first\nf:2:1: error: second\nf:1:5: error: third");
  EXPECT_STREQ(InvalidFile(diagnostics).what(), diagnostics.text().c_str());
}

TEST(Diagnostics, SentencesLeaveOutTheWord) {
  const std::vector<Diagnostic> two{{Severity::error, {"a.yaml", 3, 5}, "too short"},
                                    {Severity::error, {}, "no display"}};
  EXPECT_EQ(sentences(two), "a.yaml:3:5: too short\nno display");
  EXPECT_EQ(lines_of(two), "a.yaml:3:5: error: too short\nerror: no display");
}

TEST(Diagnostics, InvalidFileFromOneFault) {
  EXPECT_STREQ(InvalidFile({"f", 4, 2}, "broken").what(), "f:4:2: error: broken");
}

TEST(Diagnostics, WhatRepeatsIsSaidOnceWithACount) {
  Diagnostics diagnostics;
  EXPECT_FALSE(diagnostics.again("gap", {"f", 2, 1}));
  diagnostics.repeated_error("gap", {"f", 2, 5}, "no number");
  diagnostics.repeated_error("gap", {"f", 3, 5}, "no number either");
  diagnostics.repeated_error("gap", {"g", 3, 5}, "another file");
  EXPECT_TRUE(diagnostics.again("gap", {"f", 9, 1}));
  EXPECT_EQ(diagnostics.error_count(), 2);
  EXPECT_EQ(diagnostics.text(),
            "f:2:5: error: no number (and 2 more like it, the last in line 9)\n"
            "g:3:5: error: another file");
}

TEST(Diagnostics, NothingHiddenReachesTheTerminal) {
  EXPECT_EQ(to_string({Severity::error, {"a\x1B[2J.csv", 1, 1}, "\"\x07\x7F\tb\" is odd"}),
            "a\\x1B[2J.csv:1:1: error: \"\\x07\\x7F\\tb\" is odd");
  EXPECT_EQ(printable("caf\xC3\xA9 \xE2\x88\x92 \xF0\x9F\x8C\xB1"),
            "caf\xC3\xA9 \xE2\x88\x92 \xF0\x9F\x8C\xB1");
  EXPECT_EQ(in_quotes("a\nb"), "\"a\\nb\"");
  EXPECT_EQ(to_string({Severity::error, {}, "one\ntwo"}), "error: one\ntwo");
  EXPECT_EQ(printable("caf\xE9"), "caf\\xE9");  // Latin-1
  EXPECT_EQ(printable("\xC0\xAF \xED\xA0\x80"), "\\xC0\\xAF \\xED\\xA0\\x80");
  EXPECT_EQ(printable("\xC2\x9B 31m"), "\\xC2\\x9B 31m");     // a control of eight bits
  EXPECT_EQ(printable("a\xE2\x80\xAE"), "a\\xE2\\x80\\xAE");  // turns the direction of writing
  EXPECT_EQ(printable("\xE2\x82"), "\\xE2\\x82");             // cut off
}

TEST(Diagnostics, LongTextIsCut) {
  EXPECT_EQ(printable(std::string(5000, 'a')), std::string(1000, 'a') + "...");
  EXPECT_EQ(in_quotes(std::string(61, 'a')), '"' + std::string(60, 'a') + "...\"");
  const std::string line = to_string({Severity::error, {"f", 1, 1}, std::string(1 << 20, 'x')});
  EXPECT_LT(line.size(), 1100u);
}

TEST(CheckDeathTest, AssertionNamesConditionAndPlaceInEveryBuild) {
  const int one = 1;
  PEDICEL_ASSERT(one == 1);
  EXPECT_DEATH(PEDICEL_ASSERT(one == 2),
               "diagnostics_test.cpp:[0-9]+: assertion failed: one == 2 \\(a bug in Pedicel\\)");
}

}  // namespace
}  // namespace pedicel
