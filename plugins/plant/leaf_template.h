#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "plugins/cosserat/model/rod_model.h"
#include "plugins/plant/model/placed_point.h"

namespace pedicel::plant {

/// The shape of a leaf: veins and margin as the edges of a plane graph, the blade as triangles
/// between its vertices. Lengths are fractions of the leaf's size (foot of the petiole to tip).
struct LeafTemplate {
  std::string name;
  double areal_density = 0.0;             ///< kg/m2, of the blade without its veins, > 0
  cosserat::Material material;            ///< of petiole, veins and margin
  double petiole_radius = 0.0;            ///< 1, of edges at the foot that give none of their own
  double vein_radius = 0.0;               ///< 1, of other edges that give none of their own
  std::vector<Eigen::Vector2d> vertices;  ///< 1, the first is the foot (0, 0), x along the midrib
  std::vector<std::array<int, 2>> edges;  ///< vertices; a connected graph
  std::vector<double> edge_radius;        ///< 1, one an edge
  std::vector<std::array<int, 3>> triangles;  ///< vertices, anticlockwise seen from above
};

/// Reads a `pedicel-leaf` file, version 1. Every fault goes to `diagnostics` with its line and
/// column; nothing comes back where there is one. A file that cannot be read is such a fault, too.
std::optional<LeafTemplate> read_leaf_template(const std::filesystem::path& path,
                                               Diagnostics& diagnostics);

/// The same from text; `name` stands for the file in errors.
std::optional<LeafTemplate> parse_leaf_template(const std::string& text, const std::string& name,
                                                Diagnostics& diagnostics);

/// The first NAME.leaf.yaml in the folders, in their order; nothing where none has it.
std::optional<std::filesystem::path> find_leaf_template(
    const std::string& name, const std::vector<std::filesystem::path>& folders);

/// A drawn triangle of a blade; it moves with the elements that its corners sit on.
struct BladeTriangle {
  std::array<PlacedPoint, 3> corners;
};

/// Axes of a leaf: z along the face `normal`, x the way its midrib points, seen along the normal:
/// `direction` where it is given, else the curve's `tangent`. Where that is nearly parallel to the
/// normal (within 0.1 rad), leaf `number` is turned about the normal by number times the golden
/// angle, as leaves stand on a stem. The vectors need no length of 1, but must have one.
Mat3 leaf_frame(const Vec3& normal, const std::optional<Vec3>& direction, const Vec3& tangent,
                int number);

/// Grows a leaf of `size` (m, > 0, else UsageError) from the child node of `parent` (-1: the root).
/// Vertex (x, y) of the template is drawn at foot_W + size * axes_W * (x, y, 0).
///
/// Each edge is one element. Those of the spanning tree (breadth first from the foot) hang on each
/// other; each other edge closes a loop: its far node is welded to the element that ends at that
/// vertex. So every edge stretches and shears and every two neighbours bend and twist, as in the
/// paper's leaves. A weld's joint has the bending stiffness of two half edges in series, like every
/// joint. The blade has mass but no stiffness of its own: each triangle hands a third of its mass
/// to each of its corners. Its triangles are appended to `blades`.
void grow_leaf(cosserat::RodModel& model, int parent, const Vec3& foot_W, const Mat3& axes_W,
               double size, const LeafTemplate& leaf, int organ,
               std::vector<BladeTriangle>& blades);

}  // namespace pedicel::plant
