#pragma once

#include "plugins/plant/plant_file.h"

namespace pedicel::reference {

/// A straight upright stem, drawn as its unloaded shape, without damping; density 700 kg/m3.
inline plant::PlantFile straight_stem(double length, double radius, double youngs_modulus) {
  plant::PlantFile p;
  p.name = "stem";
  p.shape = plant::Shape::rest;
  p.material = {youngs_modulus, 0.35, 700.0, 0.0};
  p.connect = 0.005;
  p.distance = 0.02;
  plant::PlantCurve c;
  c.name = "stem";
  c.interpolation = plant::Interpolation::linear;
  c.points = {Vec3::Zero(), Vec3(0, 0, length)};
  c.radius = {radius};
  p.curves = {c};
  return p;
}

}  // namespace pedicel::reference
