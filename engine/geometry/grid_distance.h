#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/mesh_distance.h"

namespace pedicel {
class ThreadPool;
}

namespace pedicel::geometry {

/// How finely a mesh is sampled.
struct GridSettings {
  /// Largest error of the distance within `band`, m. Choose about a third of the smallest rod
  /// radius that touches the mesh; halving it takes 4 to 8 times the memory and time.
  double max_error = 0.0015;
  /// Distance up to which `max_error` holds on both sides of the surface, m. Choose it larger than
  /// the thickest rod's radius plus the contact's range.
  double band = 0.01;

  /// Edge of a cell, m. A distance d is 1-Lipschitz, so trilinear interpolation with weights w_i
  /// from corners x_i is off by at most sum w_i |x - x_i| <= (Jensen) sqrt(sum w_i |x - x_i|^2)
  /// <= sqrt(3)/2 spacing. (Where d is smooth the error is of second order and much smaller; the
  /// bound is reached where the nearest point of the surface jumps.)
  double spacing() const;
  /// Largest error beyond the band but within the grid, m: there the cells are 4 times as long.
  double far_error() const { return 5.0 * max_error; }
};

/// The signed distance to a mesh, sampled on a regular grid around it (single precision) and
/// interpolated trilinearly: tens of nanoseconds, not microseconds.
///
/// Outside of the grid, with s the distance to the grid's box, q the nearest point of the box and b
/// the distance of q, the true distance is at least sqrt(s^2 + b^2) and at most s + b, since the
/// mesh lies on the box's side of q; the lower bound is returned (b is off by far_error at most).
/// The distance is continuous everywhere. The gradient is the interpolant's own, made unit: it
/// jumps a little between cells. A point that is not finite has the distance NaN.
class GridDistance final : public SignedDistance {
 public:
  /// How many samples a mesh of that size (m) takes, 4 bytes each.
  static double sample_count(const Vec3& size, const GridSettings& settings);
  static constexpr double most_samples = 0x1p27;

  /// Samples the mesh. A setting that is not positive, or a grid of more than `most_samples`, is a
  /// UsageError. The bits do not depend on the number of threads.
  GridDistance(const MeshDistance& mesh, const GridSettings& settings, ThreadPool* pool = nullptr);

  double distance(const Vec3& p_L, Vec3* gradient_L = nullptr) const override;
  Aabb bounds() const override { return mesh_box_; }

  /// The region of samples, at least `band` wider than bounds() on each side.
  Aabb grid_box() const;
  const std::vector<float>& samples() const { return samples_; }

 private:
  friend class GridFile;
  GridDistance() = default;

  struct Interpolated {
    double value;  ///< m
    Vec3 slope;
  };

  /// `q` must be in grid_box().
  Interpolated interpolate(const Vec3& q) const;
  void sample_coarse(const MeshDistance& mesh, ThreadPool& pool);
  std::vector<std::uint8_t> nodes_near_surface(double band) const;
  int index(int x, int y, int z) const { return (z * nodes_.y() + y) * nodes_.x() + x; }
  Vec3 node(int x, int y, int z) const { return origin_ + spacing_ * Vec3(x, y, z); }

  Aabb mesh_box_;
  Vec3 origin_ = Vec3::Zero();  ///< the first sample
  double spacing_ = 0.0;
  Eigen::Vector3i nodes_ = Eigen::Vector3i::Zero();  ///< samples per axis: a multiple of 4, plus 1
  std::vector<float> samples_;                       ///< x fastest, then y, then z
};

}  // namespace pedicel::geometry
