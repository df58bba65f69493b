#pragma once

#include "engine/geometry/grid_distance.h"

namespace pedicel::geometry {

/// The signed distance to a mesh that is too large for a fine grid. Within `band` of the surface,
/// where contacts are, it is exact (some microseconds a query); farther away a coarse grid tells
/// how far, never more than the truth outside of the mesh, and off by at most error().
class NearExactDistance final : public SignedDistance {
 public:
  /// The coarse grid's own band is 0 or more; `band` in m.
  NearExactDistance(MeshDistance mesh, GridDistance grid, const GridSettings& grid_settings,
                    double band);

  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override { return mesh_.bounds(); }

  /// Largest error beyond the band, m: outside the distance is too small by that, never too large.
  double error() const { return 2.0 * far_error_; }

 private:
  MeshDistance mesh_;
  GridDistance grid_;
  double band_, far_error_;
};

/// Settings of a grid around a mesh of that size (m) that takes no more than so many samples.
GridSettings coarse_settings(const Vec3& size, double most_samples);

}  // namespace pedicel::geometry
