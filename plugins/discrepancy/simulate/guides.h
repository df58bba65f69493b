#pragma once

#include <vector>

#include "plugins/cosserat/contact/contact.h"

namespace pedicel::discrepancy {

/// A place that is led along one axis and slides across it without friction.
struct Guide {
  int element = 0;
  double back = 0.0;           ///< m
  Vec3 axis = Vec3::UnitX();   ///< unit, W
  bool one_sided = false;      ///< it only pushes, along the axis
  double stiffness = 0.0;      ///< N/m
  Vec3 target = Vec3::Zero();  ///< m, W, where the place is to be, at the end of the step
  Vec3 before = Vec3::Zero();  ///< m, W, likewise at its beginning
};

/// What a guide gives the plant there: N, W.
Vec3 force_of(const Guide& guide, const cosserat::RodModel& model, const cosserat::RodState& state);

/// Guides as frictionless planes that touch the plant. One that leads both ways is two planes that
/// face each other, half as stiff each and pressed together from the start: up to `pressed` newtons
/// both push, and their sum is a spring.
class Guides : public cosserat::ContactSource {
 public:
  std::vector<Guide> all;

  void cover(double from, double to) override;
  void find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
            std::vector<cosserat::ContactPoint>& found) override;

 private:
  double share_ = 1.0;  // of the way that the targets go in the step
};

}  // namespace pedicel::discrepancy
