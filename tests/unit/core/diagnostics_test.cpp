#include "core/diagnostics.h"

#include <gtest/gtest.h>

#include "core/check.h"

namespace pedicel {
namespace {

TEST(Diagnostics, LinesHaveTheFixedForm) {
  EXPECT_EQ(to_string({Severity::error, {"a.yaml", 3, 7}, "x is 1, expected 2"}),
            "a.yaml:3:7: error: x is 1, expected 2");
  EXPECT_EQ(to_string({Severity::warning, {"a.yaml", 3, 7}, "odd"}), "a.yaml:3:7: warning: odd");
  EXPECT_EQ(to_string({Severity::error, {"a.yaml"}, "absent"}), "a.yaml: error: absent");
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

TEST(CheckDeathTest, AssertionNamesConditionAndPlaceInEveryBuild) {
  const int one = 1;
  PEDICEL_ASSERT(one == 1);
  EXPECT_DEATH(PEDICEL_ASSERT(one == 2),
               "diagnostics_test.cpp:[0-9]+: assertion failed: one == 2 \\(a bug in Pedicel\\)");
}

}  // namespace
}  // namespace pedicel
