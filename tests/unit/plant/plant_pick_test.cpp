// What a stroke would hang on, and what a drawing becomes.
#include "plugins/plant/plant_pick.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/plant/plant_edit.h"

namespace pedicel::plant {
namespace {

PlantFile drawing() {
  PlantFile plant;
  plant.name = "p";
  plant.material = {1.0e8, 0.3, 800.0, 0.01};
  plant.connect = 0.01;
  plant.distance = 0.05;
  const auto add = [&](const char* name, std::vector<Vec3> points) {
    PlantCurve curve;
    curve.name = name;
    curve.points = std::move(points);
    curve.radius = {0.004};
    add_stem(plant, curve);
  };
  add("stem", {{0, 0, 0}, {0, 0, 0.4}});
  add("branch", {{0, 0, 0.2}, {0.2, 0, 0.2}});
  return plant;
}

TEST(StemPicker, FindsThePlaceNearAPoint) {
  const StemPicker picker(drawing());
  const auto found = picker.near_point({0.1, 0.006, 0.2}, 0.003);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->stem, "branch");
  EXPECT_NEAR(found->at, 0.5, 1.0e-6);
  EXPECT_NEAR(found->distance, 0.002, 1.0e-9);
  EXPECT_NEAR((found->point - Vec3(0.1, 0, 0.2)).norm(), 0.0, 1.0e-9);
  EXPECT_NEAR((found->tangent - Vec3::UnitX()).norm(), 0.0, 1.0e-9);
  EXPECT_FALSE(picker.near_point({0.1, 0.02, 0.2}, 0.003).has_value());
}

TEST(StemPicker, ReachWidensWithTheDepth) {
  const StemPicker picker(drawing());
  const Vec3 towards(0, 1, 0);
  const Vec3 beside(0.1, -2.0, 0.21);
  EXPECT_FALSE(picker.under_ray(beside, towards, 0.001, 0.001).has_value());
  const auto found = picker.under_ray(beside, towards, 0.001, 0.01);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->stem, "branch");
  EXPECT_NEAR(found->depth, 2.0, 1.0e-6);
  EXPECT_FALSE(picker.under_ray(beside, -towards, 0.001, 0.01).has_value()) << "behind";
}

TEST(StemPicker, WhatIsInFrontWins) {
  PlantFile plant = drawing();
  PlantCurve front;
  front.name = "front";
  front.points = {{-0.1, -0.3, 0.3}, {0.1, -0.3, 0.3}};
  front.radius = {0.004};
  add_stem(plant, front);
  const auto found = StemPicker(plant).under_ray({0, -1, 0.3}, {0, 1, 0}, 0.01, 0.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->stem, "front");
}

}  // namespace
}  // namespace pedicel::plant
