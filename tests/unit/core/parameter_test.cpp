#include "engine/core/parameter.h"

#include <gtest/gtest.h>

#include <limits>

namespace pedicel {
namespace {

class ParameterTest : public testing::Test {
 protected:
  double damping_ = 0.5;
  int iterations_ = 3;
  bool drawn_ = true;
  std::vector<Parameter> parameters_ = {
      {"damping", "1/s", &damping_, 0.0, 10.0, "how fast motion dies"},
      {"iterations", "1", &iterations_, 1, 100, "Newton iterations a step"},
      {"drawn", "1", &drawn_, 0, 1, "whether curves are as hung"}};
};

TEST_F(ParameterTest, SetsEveryKind) {
  EXPECT_FALSE(set_parameter(parameters_[0], 2.5));
  EXPECT_FALSE(set_parameter(parameters_[1], 7));
  EXPECT_FALSE(set_parameter(parameters_[2], 0));
  EXPECT_EQ(damping_, 2.5);
  EXPECT_EQ(iterations_, 7);
  EXPECT_FALSE(drawn_);
  EXPECT_EQ(parameters_[1].get(), 7.0);
  EXPECT_EQ(parameters_[2].get(), 0.0);
}

TEST_F(ParameterTest, BoundsThemselvesAreAllowed) {
  EXPECT_FALSE(set_parameter(parameters_[0], 0.0));
  EXPECT_FALSE(set_parameter(parameters_[0], 10.0));
}

TEST_F(ParameterTest, RefusesWithFieldValueAndBoundAndKeepsTheOldValue) {
  EXPECT_EQ(set_parameter(parameters_[0], -0.1), "damping = -0.1 1/s: must be between 0 and 10");
  EXPECT_EQ(set_parameter(parameters_[1], 101), "iterations = 101: must be between 1 and 100");
  EXPECT_EQ(set_parameter(parameters_[1], 1.5), "iterations = 1.5: must be a whole number");
  EXPECT_EQ(set_parameter(parameters_[2], 2), "drawn = 2: must be true or false");
  EXPECT_EQ(set_parameter(parameters_[0], std::numeric_limits<double>::quiet_NaN()),
            "damping = nan 1/s: must be a finite number");
  EXPECT_EQ(damping_, 0.5);
  EXPECT_EQ(iterations_, 3);
  EXPECT_TRUE(drawn_);
}

TEST_F(ParameterTest, CheckFindsTheFirstOutOfRange) {
  EXPECT_FALSE(check_parameters(parameters_));
  damping_ = 11.0;
  iterations_ = 0;
  EXPECT_EQ(check_parameters(parameters_), "damping = 11 1/s: must be between 0 and 10");
}

TEST_F(ParameterTest, FindAndNames) {
  ASSERT_NE(find_parameter(parameters_, "iterations"), nullptr);
  EXPECT_EQ(find_parameter(parameters_, "iterations")->name, "iterations");
  EXPECT_EQ(find_parameter(parameters_, "iteration"), nullptr);
  EXPECT_EQ(parameter_names(parameters_), "damping, iterations, drawn");
}

TEST(KnownUnits, AreDistinctAndHoldTheDimensionless) {
  int ones = 0;
  const auto units = known_units();
  for (std::size_t i = 0; i < units.size(); ++i) {
    ones += units[i] == "1";
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(units[i], units[j]);
  }
  EXPECT_EQ(ones, 1);
}

}  // namespace
}  // namespace pedicel
