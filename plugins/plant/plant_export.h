#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "plugins/plant/plant_file.h"

/// A plant as it is drawn, for other programs. What cannot be said there (materials, thresholds) is
/// left out.
namespace pedicel::plant {

/// x,y,z,parentid,vid,edgetype,diameter_m (m, P; "<" follows, "+" branches): what
/// read_plant_source() reads. A row a control point, in the order of the tree, and more where a
/// smooth curve would be farther than 0.2 mm from the chord; a branch begins at a row of the
/// parent's centre line. Curves that reach nothing are left out.
std::string skeleton_text(const PlantFile& plant);

/// Stems as tubes with `sides` sides, closed at both ends, and fruits as spheres; m, P.
struct PlantMesh {
  std::vector<Vec3> points, normals;          ///< one normal a point
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
  struct Part {
    std::string name;  ///< of the stem or fruit
    int first_triangle = 0;
  };
  std::vector<Part> parts;
};
PlantMesh tube_mesh(const PlantFile& plant, int sides = 12);

/// Wavefront OBJ: one object a part, with normals.
std::string obj_text(const PlantMesh& mesh, const std::string& name);
/// PLY, ASCII: points with normals, triangles.
std::string ply_text(const PlantMesh& mesh);

}  // namespace pedicel::plant
