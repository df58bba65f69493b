#pragma once

#include "engine/geometry/mesh.h"

namespace pedicel::geometry {

/// How well a mesh bounds a solid. Vertices count as one only where they are shared (load_mesh
/// merges equal ones).
struct MeshTopology {
  int components = 0;  ///< parts that no edge joins
  int open_edges = 0;  ///< edges with another number of triangles on one side than the other
  int non_manifold_edges = 0;  ///< balanced edges of more than two triangles

  /// The triangles have an inside: every edge is run through as often one way as the other.
  bool closed() const { return open_edges == 0; }
  /// Closed, in one piece, and locally a plane at every edge.
  bool manifold() const { return closed() && non_manifold_edges == 0 && components == 1; }
};

MeshTopology topology(const TriangleMesh& mesh);

/// Adds triangles until the mesh is closed: each connected set of open edges is joined to its own
/// centre (a fan). Flat round holes get the natural lid; a hole that is neither flat nor convex
/// gets one that may cut through the body. Triangles of the given mesh come first and stay as they
/// are.
TriangleMesh close_holes(const TriangleMesh& mesh);

}  // namespace pedicel::geometry
