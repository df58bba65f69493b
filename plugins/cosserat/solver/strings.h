#pragma once

#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// A string from a place of a plant to a fixed point: it pulls where it is longer than `length`,
/// and bears no pressure.
struct Tie {
  int element = 0;
  double back = 0.0;             ///< m
  Vec3 anchor_W = Vec3::Zero();  ///< m
  double length = 0.0;           ///< m, where it becomes taut
  double stiffness = 0.0;        ///< N/m
};
/// N, with which it pulls in a state.
double tension(const RodState& state, const Tie& tie);

/// In ContactPoint::collider, shapes of other plants have this number and higher ones.
constexpr int other_plant_base = 1 << 28;
constexpr bool is_other_plant(int collider) {
  return collider >= other_plant_base;
}

/// A string between places of two plants, or of one: it pulls both where it is longer than
/// `length`, and bears no pressure.
struct PlantString {
  struct End {
    int plant = 0, element = 0;
    double back = 0.0;  ///< m
  };
  End a, b;                ///< not of one element
  double length = 0.0;     ///< m, where it becomes taut
  double stiffness = 0.0;  ///< N/m
};

}  // namespace pedicel::cosserat
