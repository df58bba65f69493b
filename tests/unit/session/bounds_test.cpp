// What no simulation could hold is refused before anything is made of it.
#include <gmock/gmock.h>

#include "tests/unit/session/edit_cases.h"

namespace pedicel::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using Bounds = EditCase;

TEST_F(Bounds, AStemOfAThousandKilometresIsRefusedWithItsLength) {
  const auto before = document.state_hash();
  EXPECT_THAT(
      refusal("set length p stem 1e6"),
      AllOf(HasSubstr("stem \"stem\""), HasSubstr("1e+06 m long"), HasSubstr("at most 1000 m")));
  EXPECT_THAT(refusal("move point p stem 1 0,0,1e8"), HasSubstr("at most 1000 m"));
  EXPECT_THAT(refusal("draw stem p far 0,0,0.15;1e7,0,0 0.004"), HasSubstr("at most 1000 m"));
  EXPECT_EQ(document.state_hash(), before);
}

TEST_F(Bounds, SoAreTooManyNodes) {
  EXPECT_THAT(refusal("set sampling p distance 1e-9"),
              AllOf(HasSubstr("nodes at 1e-06 mm"), HasSubstr("at most 250000 nodes")));
  EXPECT_THAT(refusal("set plants.p.sampling.distance 1e-9"), HasSubstr("at most 250000 nodes"));
  run("set length p stem 0.9");
}

TEST_F(Bounds, WhatWasTooLongBeforeMayGetShorter) {
  document.edit_plant("p").curves[0].points.back() = Vec3(0, 0, 5e3);
  run("set plants.p.material.density 900");
  run("move point p stem 2 0,0,0.3");
}

}  // namespace
}  // namespace pedicel::app
