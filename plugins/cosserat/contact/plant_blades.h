#pragma once

#include <array>
#include <vector>

#include "plugins/cosserat/contact/self_contact.h"

namespace pedicel::cosserat {

/// A corner of a blade's triangle: a place on an element of the plant.
struct BladePlace {
  int element = 0;
  double back = 0.0;  ///< m, from the child node
};
using BladeTriangle = std::array<BladePlace, 3>;

/// The leaf blades of a plant, as triangles, for a Canopy, which makes contacts with other plants
/// of them (BladeContact). By itself it finds nothing.
class PlantBlades : public ContactSource {
 public:
  /// Triangles of one leaf follow each other. `half_thickness` in m.
  PlantBlades(std::vector<BladeTriangle> triangles, double half_thickness)
      : triangles_(std::move(triangles)), half_thickness_(half_thickness) {}

  bool is_within_plant() const override { return true; }
  void find(const RodModel&, const RodState&, double, std::vector<ContactPoint>&) override {}

  const std::vector<BladeTriangle>& triangles() const { return triangles_; }
  double half_thickness() const { return half_thickness_; }  ///< m

  /// How they touch, as the plants do; told by RodSystem and Canopy.
  const SelfContactSettings& settings() const { return settings_; }
  void change_settings(const SelfContactSettings& settings) { settings_ = settings; }

 private:
  std::vector<BladeTriangle> triangles_;
  double half_thickness_;
  SelfContactSettings settings_;
};

}  // namespace pedicel::cosserat
