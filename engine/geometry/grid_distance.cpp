#include "engine/geometry/grid_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/core/thread_pool.h"

namespace pedicel::geometry {

namespace {

/// Cells per side of a block: beyond the band only the blocks' corners are sampled.
constexpr int kBlock = 4;

/// Samples along a row of points, each using what the one before tells.
class RowSampler {
 public:
  explicit RowSampler(const MeshDistance& mesh) : mesh_(mesh) {}

  float sample(const Vec3& p) {
    // The distance changes by no more than the step, up to rounding.
    const double step = known_ ? (p - point_).norm() * (1.0 + 1e-9) + 1e-12 : 0.0;
    const double bound = known_ ? distance_ + step : std::numeric_limits<double>::infinity();
    const TriangleBvh::Nearest nearest = mesh_.nearest(p, bound);
    PEDICEL_ASSERT(nearest.triangle >= 0);
    const double distance = std::sqrt(nearest.squared_distance);
    // A change of sign needs a zero between the points.
    if (!known_ || distance + distance_ <= step) inside_ = mesh_.inside(p, nearest);
    known_ = true;
    point_ = p;
    distance_ = distance;
    return static_cast<float>(inside_ ? -distance : distance);
  }

 private:
  const MeshDistance& mesh_;
  bool known_ = false, inside_ = false;
  Vec3 point_ = Vec3::Zero();
  double distance_ = 0.0;
};

/// Blocks of cells per axis around a mesh of that size.
Vec3 blocks_of(const Vec3& mesh_size, const GridSettings& settings) {
  const Vec3 size = mesh_size + Vec3::Constant(2.0 * settings.band);
  return (size / (kBlock * settings.spacing())).array().ceil().max(1.0);
}

void check(const GridSettings& settings) {
  for (const auto& [name, value] :
       {std::pair{"max_error", settings.max_error}, std::pair{"band", settings.band}})
    if (!(value > 0.0) || !std::isfinite(value))
      throw UsageError("GridSettings." + std::string(name) + " = " + std::to_string(value) +
                       " m: must be > 0");
}

}  // namespace

double GridSettings::spacing() const {
  return 2.0 / std::sqrt(3.0) * max_error;
}

double GridDistance::sample_count(const Vec3& size, const GridSettings& settings) {
  return (kBlock * blocks_of(size, settings) + Vec3::Ones()).prod();
}

GridDistance::GridDistance(const MeshDistance& mesh, const GridSettings& settings,
                           ThreadPool* pool) {
  check(settings);
  mesh_box_ = mesh.bounds();
  spacing_ = settings.spacing();
  const double block = kBlock * spacing_;
  const Vec3 blocks = blocks_of(mesh_box_.sizes(), settings);
  const Vec3 nodes = kBlock * blocks + Vec3::Ones();
  if (!(nodes.prod() <= most_samples))
    throw UsageError("a mesh of this size at an error of " + std::to_string(settings.max_error) +
                     " m takes more than 2^27 samples, expected a larger error");
  nodes_ = nodes.cast<int>();
  origin_ = mesh_box_.center() - 0.5 * block * blocks;
  samples_.resize(static_cast<std::size_t>(nodes.prod()));

  ThreadPool own(1);
  ThreadPool& threads = pool ? *pool : own;
  sample_coarse(mesh, threads);
  const std::vector<std::uint8_t> near = nodes_near_surface(settings.band);
  threads.for_each(nodes_.z() * nodes_.y(), [&](int row) {
    if (stop_requested) return;
    const int y = row % nodes_.y(), z = row / nodes_.y();
    RowSampler sampler(mesh);
    for (int x = 0; x < nodes_.x(); ++x)
      if (near[index(x, y, z)]) samples_[index(x, y, z)] = sampler.sample(node(x, y, z));
  });
  throw_if_stopped();  // rows are missing then
}

void GridDistance::sample_coarse(const MeshDistance& mesh, ThreadPool& pool) {
  const Eigen::Vector3i coarse = (nodes_.array() - 1) / kBlock + 1;
  pool.for_each(coarse.z() * coarse.y(), [&](int row) {
    if (stop_requested) return;
    const int y = kBlock * (row % coarse.y()), z = kBlock * (row / coarse.y());
    RowSampler sampler(mesh);
    for (int x = 0; x < nodes_.x(); x += kBlock)
      samples_[index(x, y, z)] = sampler.sample(node(x, y, z));
  });
  throw_if_stopped();
  // Between them linearly, axis by axis: exactly the trilinear interpolant of the coarse cells.
  const auto fill = [&](int from, int step, int k) {
    const float t = static_cast<float>(k) / kBlock;
    const float low = samples_[from], high = samples_[from + kBlock * step];
    samples_[from + k * step] = (1.0f - t) * low + t * high;
  };
  const int step_y = nodes_.x(), step_z = nodes_.x() * nodes_.y();
  for (int z = 0; z < nodes_.z(); z += kBlock)
    for (int y = 0; y < nodes_.y(); y += kBlock)
      for (int x = 0; x + 1 < nodes_.x(); ++x)
        if (x % kBlock) fill(index(x - x % kBlock, y, z), 1, x % kBlock);
  for (int z = 0; z < nodes_.z(); z += kBlock)
    for (int y = 0; y + 1 < nodes_.y(); ++y)
      for (int x = 0; y % kBlock && x < nodes_.x(); ++x)
        fill(index(x, y - y % kBlock, z), step_y, y % kBlock);
  for (int z = 0; z + 1 < nodes_.z(); ++z)
    for (int y = 0; z % kBlock && y < nodes_.y(); ++y)
      for (int x = 0; x < nodes_.x(); ++x) fill(index(x, y, z - z % kBlock), step_z, z % kBlock);
}

std::vector<std::uint8_t> GridDistance::nodes_near_surface(double band) const {
  std::vector<std::uint8_t> near(samples_.size(), 0);
  // A point of the band is within half a block's diagonal of some corner of its block.
  const double limit = band + 0.5 * std::sqrt(3.0) * kBlock * spacing_;
  for (int z = 0; z + 1 < nodes_.z(); z += kBlock)
    for (int y = 0; y + 1 < nodes_.y(); y += kBlock)
      for (int x = 0; x + 1 < nodes_.x(); x += kBlock) {
        double smallest = std::numeric_limits<double>::infinity();
        for (int corner = 0; corner < 8; ++corner)
          smallest = std::min<double>(
              smallest,
              std::abs(samples_[index(x + kBlock * (corner & 1), y + kBlock * (corner >> 1 & 1),
                                      z + kBlock * (corner >> 2 & 1))]));
        if (smallest > limit) continue;
        for (int k = 0; k <= kBlock; ++k)
          for (int j = 0; j <= kBlock; ++j)
            std::fill_n(near.begin() + index(x, y + j, z + k), kBlock + 1, std::uint8_t{1});
      }
  return near;
}

Aabb GridDistance::grid_box() const {
  return {origin_, node(nodes_.x() - 1, nodes_.y() - 1, nodes_.z() - 1)};
}

GridDistance::Interpolated GridDistance::interpolate(const Vec3& q) const {
  const Vec3 cells = (q - origin_) / spacing_;
  int cell[3];
  double t[3];
  for (int k = 0; k < 3; ++k) {
    cell[k] = std::clamp(static_cast<int>(cells[k]), 0, nodes_[k] - 2);
    t[k] = cells[k] - cell[k];
  }
  // Along x, then y, then z, carrying the derivatives along.
  const float* corner = &samples_[index(cell[0], cell[1], cell[2])];
  const int step_y = nodes_.x(), step_z = nodes_.x() * nodes_.y();
  double value[2], dx[2], dy[2];
  for (int k = 0; k < 2; ++k) {
    const float* low = corner + k * step_z;
    const float* high = low + step_y;
    const double slope_low = double(low[1]) - low[0], slope_high = double(high[1]) - high[0];
    const double at_low = low[0] + t[0] * slope_low, at_high = high[0] + t[0] * slope_high;
    dx[k] = slope_low + t[1] * (slope_high - slope_low);
    dy[k] = at_high - at_low;
    value[k] = at_low + t[1] * dy[k];
  }
  const double dz = value[1] - value[0];
  const Vec3 change(dx[0] + t[2] * (dx[1] - dx[0]), dy[0] + t[2] * (dy[1] - dy[0]), dz);
  return {value[0] + t[2] * dz, change / spacing_};
}

double GridDistance::distance(const Vec3& p_L, Vec3* gradient_L) const {
  if (!p_L.allFinite()) {
    if (gradient_L) *gradient_L = Vec3::UnitZ();
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Aabb box = grid_box();
  const Vec3 q = p_L.cwiseMax(box.min()).cwiseMin(box.max());
  const Interpolated at = interpolate(q);
  const Vec3 beyond = p_L - q;
  const double s = beyond.norm();
  if (s == 0.0) {
    if (gradient_L)
      *gradient_L = unit_or(at.slope, unit_or(p_L - mesh_box_.center(), Vec3::UnitZ()));
    return at.value;
  }
  if (gradient_L) {
    // d sqrt(s^2 + b^2); on the axes where q stays at the border, b does not change.
    const Vec3 along = (beyond.array() == 0.0).select(at.slope, Vec3::Zero());
    *gradient_L = unit_or(beyond + at.value * along, beyond / s);
  }
  return std::hypot(s, at.value);
}

}  // namespace pedicel::geometry
