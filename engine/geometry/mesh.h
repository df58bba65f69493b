#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "engine/core/frames.h"

namespace pedicel::geometry {

/// A triangle mesh in its own frame, vertices shared between triangles.
struct TriangleMesh {
  std::vector<Vec3> vertices;                 ///< m
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Loads STL, OBJ, DAE, glTF or GLB (assimp): all sub-meshes with their node transforms applied,
/// equal vertices merged, degenerate triangles dropped. DAE keeps its own axes (no Z_UP to Y_UP
/// turn) and its unit is applied, as ROS users expect; `scale` multiplies each axis afterwards.
/// Throws InvalidFile ("path: error: what, and what was expected").
TriangleMesh load_mesh(const std::filesystem::path& path, const Vec3& scale = Vec3::Ones());

}  // namespace pedicel::geometry
