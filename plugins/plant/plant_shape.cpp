#include "plugins/plant/plant_shape.h"

#include <algorithm>

namespace pedicel::plant {

namespace {

using What = ShapeFactor::What;

void scale_radii(PlantFile& plant, double factor) {
  for (PlantCurve& curve : plant.curves) {
    for (double& radius : curve.radius) radius *= factor;
    curve.section.width *= factor;
    curve.section.height *= factor;
  }
}

void scale_lengths(PlantFile& plant, double factor) {
  for (PlantCurve& curve : plant.curves)
    for (Vec3& point : curve.points) point = plant.root + factor * (point - plant.root);
  plant.connect *= factor;
  plant.distance *= factor;
}

}  // namespace

std::span<const ShapeFactor> shape_factors() {
  static const ShapeFactor all[] = {
      {"shape.radius", What::radius, "Factor on the thickness of all stems."},
      {"shape.length", What::length, "Factor on the length of all stems, about the root."},
      {"shape.fruit", What::fruit, "Factor on the radius of all fruits."},
      {"shape.leaf", What::leaf, "Factor on the size of all leaves."}};
  return all;
}

const ShapeFactor* find_shape_factor(std::string_view key) {
  const auto all = shape_factors();
  const auto found = std::ranges::find(all, key, &ShapeFactor::key);
  return found == all.end() ? nullptr : &*found;
}

void scale_shape(PlantFile& plant, What what, double factor) {
  if (factor == 1.0) return;
  if (what == What::radius) scale_radii(plant, factor);
  if (what == What::length) scale_lengths(plant, factor);
  if (what == What::fruit)
    for (PlantFruit& fruit : plant.fruits) fruit.radius *= factor;
  if (what == What::leaf)
    for (PlantLeaf& leaf : plant.leaves) leaf.size *= factor;
}

}  // namespace pedicel::plant
