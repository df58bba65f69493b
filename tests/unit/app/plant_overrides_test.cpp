#include "app/plant_overrides.h"

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
  apply_plant_overrides(file, {{key, text, {"s.scene.yaml", 7, 9}}}, diagnostics);
  return diagnostics.text();
}

TEST(PlantOverrides, AThresholdIsSetOnEveryFruit) {
  plant::PlantFile file = plant();
  EXPECT_EQ(apply(file, "detach.stretch", "0.25"), "");
  for (const plant::PlantFruit& fruit : file.fruits) EXPECT_EQ(fruit.detach.stretch, 0.25);
}

TEST(PlantOverrides, AMaterialValueHoldsForTheWholePlant) {
  plant::PlantFile file = plant();
  EXPECT_EQ(apply(file, "material.density", "300"), "");
  EXPECT_EQ(file.material.density, 300);
  EXPECT_FALSE(file.curves[1].material.density);
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
                        "detach.bend"));
  EXPECT_THAT(apply(file, "detach.stretch", "-1"), HasSubstr("detach.stretch is \"-1\", expected"));
  EXPECT_THAT(apply(file, "material.poisson_ratio", "0.6"), HasSubstr("poisson_ratio is \"0.6\""));
  EXPECT_THAT(apply(file, "sampling.distance", "far"), HasSubstr("sampling.distance is \"far\""));
  EXPECT_EQ(file, plant());
}

}  // namespace
}  // namespace pedicel::app
