#pragma once

#include "engine/geometry/mesh.h"
#include "engine/render/instanced_mesh.h"

namespace pedicel::render {

/// Position and normal of every corner of a mesh, ready to draw: faces that meet at less than
/// `crease` (rad) are shaded smoothly, sharper edges stay sharp. Faces weigh by area.
MeshData with_normals(const geometry::TriangleMesh& mesh, double crease = 0.6);

/// Whether a mesh encloses a volume, with its faces looking outwards: every edge has one face to
/// either side. Vertices at one place count as one.
bool is_closed(const geometry::TriangleMesh& mesh);

}  // namespace pedicel::render
