#pragma once

#include <array>
#include <memory>

#include "engine/render/instanced_mesh.h"

namespace pedicel::render {

/// The shapes that instances are made of, at several levels of detail: software rendering costs by
/// the triangle, and a stem two pixels wide needs few.
class UnitMeshes {
 public:
  static constexpr int levels = 4;

  explicit UnitMeshes(const GlFunctions& gl);

  /// The level for something whose radius covers that many pixels.
  static int level_for(double radius_px);

  /// An open stretch of a tube, straight or with rings along it to follow a curve.
  const InstancedMesh& tube(int level, bool curved) const { return *tubes_[curved][level]; }
  /// The same closed by half spheres.
  const InstancedMesh& capsule(int level, bool curved) const { return *capsules_[curved][level]; }
  const InstancedMesh& sphere(int level) const { return *spheres_[level]; }
  const InstancedMesh& cube() const { return *cube_; }
  const InstancedMesh& blade() const { return *blade_; }
  const InstancedMesh& line() const { return *line_; }

 private:
  using Shape = std::unique_ptr<InstancedMesh>;
  std::array<std::array<Shape, levels>, 2> tubes_, capsules_;
  std::array<Shape, levels> spheres_;
  Shape cube_, blade_, line_;
};

/// Attribute sizes of a loaded mesh and its instances (rows of the pose, colour, surface).
VertexLayout mesh_layout();

/// A sphere of radius 1 as an octahedron whose faces are split `times` in two along every edge.
MeshData unit_sphere(int times);

/// A tube of `sides` and `stretches` along; `caps` rings of latitude at either end (0: open).
MeshData unit_tube(int sides, int stretches, int caps);

}  // namespace pedicel::render
