#include "plugins/simulation/large_plant.h"

#include <gtest/gtest.h>

namespace pedicel::app {
namespace {

std::string said(std::size_t curves) {
  plant::PlantFile file;
  file.name = "p";
  file.curves.resize(curves);
  for (plant::PlantCurve& curve : file.curves) curve.points.resize(2, Vec3::Zero());
  ::testing::internal::CaptureStderr();
  simulation::say_if_large(file);
  return ::testing::internal::GetCapturedStderr();
}

TEST(LargePlant, IsSaidBeforeItIsBuilt) {
  EXPECT_EQ(said(100), "");
  EXPECT_EQ(said(20'000), "p: 40000 points in 20000 curves, building it takes a while\n");
}

}  // namespace
}  // namespace pedicel::app
