#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/core/frames.h"

namespace pedicel::plant {

/// Points in the cells of a cubic grid, to find those near a place without looking at all of them.
/// Points are numbered from 0 on as they are added.
class PointGrid {
 public:
  struct Nearest {
    int point = -1;
    double distance = 0.0;  ///< m
  };

  /// `reach` (m, more than 0): how far lookups see.
  explicit PointGrid(double reach);

  void add(const Vec3& point);
  int size() const { return static_cast<int>(points_.size()); }
  const Vec3& operator[](int point) const { return points_[static_cast<std::size_t>(point)]; }

  /// Calls visit(point) for every point nearer to `place` than `reach`, and for some that are not,
  /// in no useful order.
  template <class Visit>
  void for_each_near(const Vec3& place, const Visit& visit) const {
    const Cell centre = cell_of(place);
    for (int k = 0; k < 27; ++k) {
      const auto cell =
          cells_.find({centre.x + k % 3 - 1, centre.y + k / 3 % 3 - 1, centre.z + k / 9 - 1});
      if (cell == cells_.end()) continue;
      for (const int point : cell->second) visit(point);
    }
  }

  /// The nearest point that is nearer than `reach`; of equally near ones the one added first, as a
  /// loop over all of them finds it. Point -1 where there is none.
  Nearest nearest(const Vec3& place) const;

 private:
  struct Cell {
    std::int64_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };
  Cell cell_of(const Vec3& place) const;

  double reach_, side_;  // m
  std::vector<Vec3> points_;
  std::unordered_map<Cell, std::vector<int>, Hash> cells_;
};

}  // namespace pedicel::plant
