#include "engine/world/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace pedicel::world {
namespace {

using Kind = Expectation::Test;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Expectation expect(Kind test, double low = 0.0, double high = 0.0) {
  Expectation e;
  e.quantity = "detach_time_s";
  e.fruit = "truss/fruit_3";
  e.test = test;
  e.low = low;
  e.high = high;
  return e;
}

TEST(Expectation, JudgesByItsBound) {
  EXPECT_TRUE(judge(expect(Kind::is, 2.0), 2.0).met);
  EXPECT_FALSE(judge(expect(Kind::is, 2.0), 2.1).met);
  EXPECT_TRUE(judge(expect(Kind::between, 1.0, 3.0), 3.0).met);
  EXPECT_FALSE(judge(expect(Kind::between, 1.0, 3.0), 3.01).met);
  EXPECT_TRUE(judge(expect(Kind::above, 1.0), 1.1).met);
  EXPECT_FALSE(judge(expect(Kind::above, 1.0), 1.0).met);
  EXPECT_TRUE(judge(expect(Kind::below, 1.0), 0.9).met);
  EXPECT_FALSE(judge(expect(Kind::below, 1.0), 1.0).met);
}

TEST(Expectation, WhatWasNotMeasuredMeetsNothing) {
  for (Kind test : {Kind::is, Kind::between, Kind::above, Kind::below})
    EXPECT_FALSE(judge(expect(test, 0.0, 1.0), nothing).met);
}

TEST(Expectation, ASweepMustRiseOrFallStrictly) {
  const std::array rising = {1.0, 1.5, 2.0}, level = {1.0, 1.0, 2.0}, holed = {1.0, nothing, 2.0};
  EXPECT_TRUE(judge_sweep(expect(Kind::rises_with_sweep), rising).met);
  EXPECT_FALSE(judge_sweep(expect(Kind::rises_with_sweep), level).met);
  EXPECT_FALSE(judge_sweep(expect(Kind::rises_with_sweep), holed).met);
  EXPECT_FALSE(judge_sweep(expect(Kind::falls_with_sweep), rising).met);
  EXPECT_TRUE(judge_sweep(expect(Kind::falls_with_sweep), std::array{2.0, 1.0}).met);
  EXPECT_FALSE(judge_sweep(expect(Kind::rises_with_sweep), std::array{2.0}).met);
}

TEST(Expectation, SteadyMeansNearTheMeanOfTheSweep) {
  const std::array values = {0.9, 1.0, 1.1}, holed = {1.0, nothing, 1.0};
  EXPECT_TRUE(judge_sweep(expect(Kind::steady_over_sweep, 0.11), values).met);
  EXPECT_FALSE(judge_sweep(expect(Kind::steady_over_sweep, 0.09), values).met);
  EXPECT_FALSE(judge_sweep(expect(Kind::steady_over_sweep, 0.5), holed).met);
}

TEST(Expectation, SaysWhatWasExpectedAndMeasured) {
  EXPECT_EQ(to_string(judge(expect(Kind::between, 1.0, 3.0), 4.25)),
            "NOT MET detach_time_s of truss/fruit_3 between 1 and 3: 4.25");
  EXPECT_EQ(to_string(judge(expect(Kind::above, 1.0), nothing)),
            "NOT MET detach_time_s of truss/fruit_3 above 1: nothing");
  EXPECT_EQ(to_string(judge_sweep(expect(Kind::rises_with_sweep), std::array{1.0, 2.0})),
            "met     detach_time_s of truss/fruit_3 rises with the sweep: 1, 2");
}

}  // namespace
}  // namespace pedicel::world
