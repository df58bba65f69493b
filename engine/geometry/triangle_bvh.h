#pragma once

#include <limits>
#include <vector>

#include "engine/geometry/aabb.h"
#include "engine/geometry/closest_point.h"

namespace pedicel::geometry {

/// A tree of boxes over the triangles of a mesh, for nearest points and winding numbers.
class TriangleBvh {
 public:
  /// A mesh without triangles is a UsageError.
  explicit TriangleBvh(const TriangleMesh& mesh);

  struct Nearest {
    int triangle = -1;  ///< index in the mesh; -1: none within the bound
    TrianglePoint at;
    double squared_distance = std::numeric_limits<double>::infinity();  ///< m2
  };

  /// The point of the mesh nearest to p, if it is nearer than `bound` (m).
  Nearest nearest(const Vec3& p, double bound = std::numeric_limits<double>::infinity()) const;

  /// How often the mesh encloses p: 1 inside, 0 outside of a closed mesh, between them for one with
  /// holes (A. Jacobson et al., ACM Trans. Graph. 32, 2013). Far groups of triangles act as one
  /// dipole (G. Barill et al., ACM Trans. Graph. 37, 2018), so a few percent may be amiss.
  double winding_number(const Vec3& p) const;

  const Aabb& bounds() const { return nodes_.front().box; }

 private:
  struct Node {
    Aabb box;
    int first = 0, count = 0;  ///< corners_[first .. first + count)
    int second_child = -1;     ///< the first child is the next node; -1: a leaf
  };
  struct Dipole {
    Vec3 centre, area;  ///< area-weighted centre (m); sum of area times normal (m2)
    double radius;      ///< of a sphere about the centre that holds the triangles, m
  };
  struct Corners {
    Vec3 a, b, c;
    int triangle;
  };

  void build(int first, int count);
  Dipole dipole(int first, int count) const;

  std::vector<Node> nodes_;
  std::vector<Dipole> dipoles_;  ///< one per node
  std::vector<Corners> corners_;
};

}  // namespace pedicel::geometry
