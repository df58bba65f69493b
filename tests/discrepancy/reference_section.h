#pragma once

#include "engine/core/frames.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::reference {

/// A cross-section by its own axes 1 (along the smaller extent, the file's `normal`) and 2.
struct SectionValues {
  double bend1 = 0.0, bend2 = 0.0;        ///< N m2, bending about the axes
  double twist = 0.0;                     ///< N m2
  double stretch = 0.0;                   ///< N, EA
  double mass = 0.0;                      ///< kg/m
  double inertia1 = 0.0, inertia2 = 0.0;  ///< kg m, rho I about the axes
};

/// Solid sections; torsion constants as in Young & Budynas, Roark's Formulas, table 10.7.
SectionValues section_values(const plant::SectionShape& shape, double radius, double youngs_modulus,
                             double poisson_ratio, double density);

/// A frame whose third axis is `along` (unit): its first axis lies along `normal`, or, where that
/// is zero, where the frame before it turns to on the shortest way.
Quat frame_along(const Vec3& along, const Vec3& normal, const Quat& before);

}  // namespace pedicel::reference
