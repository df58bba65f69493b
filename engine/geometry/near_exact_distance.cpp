#include "engine/geometry/near_exact_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pedicel::geometry {

NearExactDistance::NearExactDistance(MeshDistance mesh, GridDistance grid,
                                     const GridSettings& grid_settings, double band)
    : mesh_(std::move(mesh)),
      grid_(std::move(grid)),
      band_(band),
      far_error_(grid_settings.far_error()) {}

double NearExactDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  const double coarse = grid_.distance(p_L, gradient_L);
  if (std::abs(coarse) <= band_ + far_error_) return mesh_.distance(p_L, gradient_L);
  return coarse > 0.0 ? coarse - far_error_ : coarse;  // NaN stays NaN
}

GridSettings coarse_settings(const Vec3& size, double most_samples) {
  GridSettings settings;
  while (GridDistance::sample_count(size, settings) > most_samples) {
    settings.max_error *= 1.1;
    settings.band = settings.spacing();
  }
  return settings;
}

}  // namespace pedicel::geometry
