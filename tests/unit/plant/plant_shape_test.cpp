#include "plugins/plant/plant_shape.h"

#include <gtest/gtest.h>

namespace pedicel::plant {
namespace {

PlantFile plant() {
  PlantFile file;
  file.root = Vec3(1, 0, 0);
  file.connect = 0.01;
  file.distance = 0.025;
  PlantCurve curve;
  curve.points = {Vec3(1, 0, 0), Vec3(1, 0, 0.5)};
  curve.radius = {0.004, 0.002};
  curve.section.width = 0.08;
  file.curves = {curve};
  file.fruits.emplace_back().radius = 0.02;
  file.leaves.emplace_back().size = 0.1;
  return file;
}

void scale(PlantFile& file, const char* key, double factor) {
  const ShapeFactor* found = find_shape_factor(key);
  ASSERT_TRUE(found) << key;
  scale_shape(file, found->what, factor);
}

TEST(PlantShape, EachFactorChangesItsOwnAlone) {
  PlantFile file = plant();
  scale(file, "shape.radius", 2.0);
  EXPECT_EQ(file.curves[0].radius, (std::vector<double>{0.008, 0.004}));
  EXPECT_EQ(file.curves[0].section.width, 0.16);
  EXPECT_EQ(file.curves[0].points, plant().curves[0].points);
  file = plant();
  scale(file, "shape.length", 2.0);
  EXPECT_EQ(file.curves[0].points, (std::vector<Vec3>{Vec3(1, 0, 0), Vec3(1, 0, 1)}));
  EXPECT_EQ(file.curves[0].radius, plant().curves[0].radius);
  EXPECT_EQ(file.connect, 0.02);
  EXPECT_EQ(file.distance, 0.05);
  file = plant();
  scale(file, "shape.fruit", 0.5);
  scale(file, "shape.leaf", 3.0);
  EXPECT_EQ(file.fruits[0].radius, 0.01);
  EXPECT_DOUBLE_EQ(file.leaves[0].size, 0.3);
  EXPECT_EQ(file.curves, plant().curves);
}

TEST(PlantShape, OneLeavesItAsItIs) {
  PlantFile file = plant();
  for (const ShapeFactor& factor : shape_factors()) scale_shape(file, factor.what, 1.0);
  EXPECT_EQ(file, plant());
  EXPECT_FALSE(find_shape_factor("shape.smell"));
}

}  // namespace
}  // namespace pedicel::plant
