#include "engine/geometry/mesh_topology.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace pedicel::geometry {

namespace {

/// One side of a triangle, under its edge (low, high).
struct Side {
  int low, high;
  int direction;  ///< +1 when the triangle runs from low to high
  int triangle;
};

/// All sides, those of an edge next to each other.
std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[i][k], to = mesh.triangles[i][(k + 1) % 3];
      sides.push_back(
          {std::min(from, to), std::max(from, to), from < to ? 1 : -1, static_cast<int>(i)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// Calls visit(first, last, balance) with the sides of each edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit) {
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first;
    int balance = 0;
    for (; last != sides.end() && last->low == first->low && last->high == first->high; ++last)
      balance += last->direction;
    visit(first, last, balance);
    first = last;
  }
}

/// Disjoint sets of the numbers 0 to n - 1.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Returns whether they were apart.
  bool join(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

MeshTopology topology(const TriangleMesh& mesh) {
  MeshTopology result;
  result.components = static_cast<int>(mesh.triangles.size());
  Sets parts(mesh.triangles.size());
  for_each_edge(sorted_sides(mesh), [&](auto first, auto last, int balance) {
    if (balance != 0) ++result.open_edges;
    if (balance == 0 && last - first > 2) ++result.non_manifold_edges;
    for (auto side = first + 1; side < last; ++side)
      if (parts.join(first->triangle, side->triangle)) --result.components;
  });
  return result;
}

TriangleMesh close_holes(const TriangleMesh& mesh) {
  std::vector<Side> rim;  // direction: by how much the edge is short from high to low
  Sets holes(mesh.vertices.size());
  for_each_edge(sorted_sides(mesh), [&](auto first, auto, int balance) {
    if (balance == 0) return;
    rim.push_back({first->low, first->high, balance, first->triangle});
    holes.join(first->low, first->high);
  });

  TriangleMesh closed = mesh;
  std::vector<int> centre(mesh.vertices.size(), -1);
  std::vector<double> weight(mesh.vertices.size(), 0.0);
  for (const Side& edge : rim) {
    const int hole = holes.find(edge.low);
    if (centre[hole] < 0) {
      centre[hole] = static_cast<int>(closed.vertices.size());
      closed.vertices.push_back(Vec3::Zero());
    }
    const Vec3 &a = mesh.vertices[edge.low], &b = mesh.vertices[edge.high];
    closed.vertices[centre[hole]] += (b - a).norm() * 0.5 * (a + b);
    weight[hole] += (b - a).norm();
  }
  for (std::size_t hole = 0; hole < centre.size(); ++hole)
    if (centre[hole] >= 0) closed.vertices[centre[hole]] /= weight[hole];

  for (const Side& edge : rim) {
    const int tip = centre[holes.find(edge.low)];
    for (int i = 0; i < std::abs(edge.direction); ++i) {
      if (edge.direction > 0)
        closed.triangles.push_back({edge.high, edge.low, tip});
      else
        closed.triangles.push_back({edge.low, edge.high, tip});
    }
  }
  return closed;
}

}  // namespace pedicel::geometry
