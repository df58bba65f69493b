#include "plugins/plant/point_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/check.h"

namespace pedicel::plant {

// A little more than the reach, so that rounding never puts a near point two cells away.
PointGrid::PointGrid(double reach) : reach_(reach), side_(reach * (1.0 + 1.0e-9)) {
  if (!(reach > 0.0) || !std::isfinite(reach))
    throw UsageError("PointGrid.reach = " + std::to_string(reach) + " m: must be > 0");
}

PointGrid::Cell PointGrid::cell_of(const Vec3& place) const {
  // Beyond this a cell's number would not fit; everything out there shares the outermost cells.
  constexpr double farthest = 1.0e18;
  const auto index = [&](double x) {
    return static_cast<std::int64_t>(std::clamp(std::floor(x / side_), -farthest, farthest));
  };
  return {index(place.x()), index(place.y()), index(place.z())};
}

std::size_t PointGrid::Hash::operator()(const Cell& cell) const {
  const auto mixed = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15ull ^
                     static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4Full ^
                     static_cast<std::uint64_t>(cell.z) * 0x165667B19E3779F9ull;
  return mixed ^ mixed >> 32;
}

void PointGrid::add(const Vec3& point) {
  cells_[cell_of(point)].push_back(size());
  points_.push_back(point);
}

PointGrid::Nearest PointGrid::nearest(const Vec3& place) const {
  Nearest best{-1, reach_};
  for_each_near(place, [&](int point) {
    const double distance = ((*this)[point] - place).norm();
    if (distance < best.distance || (distance == best.distance && point < best.point))
      best = {point, distance};
  });
  return best;
}

}  // namespace pedicel::plant
