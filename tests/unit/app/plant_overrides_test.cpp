#include "plugins/simulation/plants/plant_overrides.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

plant::PlantFile plant() {
  plant::PlantFile file;
  file.material.density = 700;
  file.curves.resize(2);
  file.curves[1].material.density = 900;
  file.fruits.resize(2);
  file.fruits[0].detach.stretch = 0.1;
  return file;
}

std::string apply(plant::PlantFile& file, const std::string& key, const std::string& text) {
  Diagnostics diagnostics;
  simulation::apply_plant_overrides(file, {{key, text, {"s.scene.yaml", 7, 9}}}, diagnostics);
  return diagnostics.text();
}

TEST(PlantOverrides, AThresholdIsSetOnEveryFruit) {
  plant::PlantFile file = plant();
  EXPECT_EQ(apply(file, "detach.stretch", "0.25"), "");
  for (const plant::PlantFruit& fruit : file.fruits) EXPECT_EQ(fruit.detach.stretch, 0.25);
}

TEST(PlantOverrides, CurvesOfAnotherMaterialKeepTheirRatioToThePlants) {
  plant::PlantFile file = plant();
  EXPECT_EQ(apply(file, "material.density", "300"), "");
  EXPECT_EQ(file.material.density, 300);
  EXPECT_FALSE(file.curves[0].material.density);
  ASSERT_TRUE(file.curves[1].material.density);
  EXPECT_DOUBLE_EQ(*file.curves[1].material.density, 900.0 * 300.0 / 700.0);
}

TEST(PlantOverrides, TheNumberThatThePlantHasChangesNothing) {
  plant::PlantFile file = plant();
  EXPECT_EQ(apply(file, "material.density", "700"), "");
  EXPECT_EQ(file, plant());
}

TEST(PlantOverrides, WithoutANumberOfThePlantAllCurvesGetIt) {
  plant::PlantFile file = plant();
  file.curves[0].material.youngs_modulus = 1e7;
  EXPECT_EQ(apply(file, "material.youngs_modulus", "1e9"), "");
  EXPECT_EQ(file.material.youngs_modulus, 1e9);
  EXPECT_FALSE(file.curves[0].material.youngs_modulus);
}

TEST(PlantOverrides, APoissonRatioOfACurveStaysPossible) {
  plant::PlantFile file = plant();
  file.material.poisson_ratio = 0.2;
  file.curves[0].material.poisson_ratio = 0.3;
  EXPECT_EQ(apply(file, "material.poisson_ratio", "0.4"), "");
  EXPECT_EQ(file.curves[0].material.poisson_ratio, 0.5);
}

TEST(PlantOverrides, SamplingIsSet) {
  plant::PlantFile file = plant();
  EXPECT_EQ(apply(file, "sampling.distance", "0.035") + apply(file, "sampling.connect", "0.01"),
            "");
  EXPECT_EQ(file.distance, 0.035);
  EXPECT_EQ(file.connect, 0.01);
}

TEST(PlantOverrides, RefusalsNamePlaceKeyAndWhatWasExpected) {
  plant::PlantFile file = plant();
  EXPECT_THAT(apply(file, "detach.strech", "1"),
              HasSubstr("s.scene.yaml:7:9: error: unknown key \"detach.strech\", expected one of: "
                        "material.youngs_modulus"));
  EXPECT_THAT(apply(file, "detach.stretch", "-1"), HasSubstr("detach.stretch is \"-1\", expected"));
  EXPECT_THAT(apply(file, "material.poisson_ratio", "0.6"), HasSubstr("poisson_ratio is \"0.6\""));
  EXPECT_THAT(apply(file, "sampling.distance", "far"), HasSubstr("sampling.distance is \"far\""));
  EXPECT_EQ(file, plant());
}

}  // namespace
}  // namespace pedicel::app
