#include "plugins/plant/leaf_template.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/check.h"
#include "engine/io/yaml.h"
#include "plugins/plant/model/plant_model.h"

namespace pedicel::plant {

namespace {

using io::YamlMap;
using io::YamlNode;

constexpr double shortest = 1.0e-6;  // 1, fraction of the size: nearer vertices are the same

cosserat::Material read_material(const YamlNode& node) {
  YamlMap map(node, "material");
  // A leaf has no other material to take them from.
  MaterialValues values;
  for (const MaterialKey& key : material_keys)
    if (key.needed)
      set_number_of<MaterialValues>(values, key, map.number(std::string(key.name), key.bounds));
  map.finish();
  return {*values.youngs_modulus, *values.poisson_ratio, *values.density, *values.damping_time};
}

void read_vertices(const YamlNode& node, LeafTemplate& leaf) {
  for (const YamlNode& item : node.list("vertices")) {
    const std::string what = "vertex " + std::to_string(leaf.vertices.size());
    const std::vector<double> at = item.numbers(what);
    if (at.size() != 2 && item.is_list())
      item.error(what + " has " + std::to_string(at.size()) + " numbers, expected [x, y]");
    leaf.vertices.push_back(at.size() == 2 ? Eigen::Vector2d(at[0], at[1])
                                           : Eigen::Vector2d(0.0, 0.0));
  }
}

// N different vertices.
template <std::size_t N>
std::array<int, N> read_corners(const YamlNode& node, const std::string& what, int vertices) {
  std::array<int, N> corners{};
  const std::vector<YamlNode> list = node.list(what);
  if (list.size() != N && node.is_list())
    node.error(what + " has " + std::to_string(list.size()) + " vertices, expected " +
               std::to_string(N));
  if (list.size() != N) return corners;
  const int before = node.diagnostics().error_count();
  for (std::size_t i = 0; i < N; ++i)
    corners[i] = list[i].integer("a vertex of " + what, 0, vertices - 1);
  if (node.diagnostics().error_count() == before &&
      std::set<int>(corners.begin(), corners.end()).size() != N)
    node.error(what + " names a vertex twice, expected " + std::to_string(N) + " different ones");
  return corners;
}

void read_edge(const YamlNode& node, LeafTemplate& leaf) {
  YamlMap map(node, "an edge");
  std::array<int, 2> ends{};
  if (const auto list = map.required("ends"))
    ends = read_corners<2>(*list, "ends", static_cast<int>(leaf.vertices.size()));
  const bool at_foot = ends[0] == 0 || ends[1] == 0;
  const double radius =
      map.number("radius", io::positive, at_foot ? leaf.petiole_radius : leaf.vein_radius);
  map.finish();
  for (const std::array<int, 2>& other : leaf.edges)
    if (ends[0] != ends[1] && std::minmax(ends[0], ends[1]) == std::minmax(other[0], other[1]))
      node.error("the edge from vertex " + std::to_string(ends[0]) + " to vertex " +
                 std::to_string(ends[1]) + " is there already, expected once");
  leaf.edges.push_back(ends);
  leaf.edge_radius.push_back(radius);
}

double twice_area(const LeafTemplate& leaf, const std::array<int, 3>& corners) {
  const Eigen::Vector2d a = leaf.vertices[corners[1]] - leaf.vertices[corners[0]];
  const Eigen::Vector2d b = leaf.vertices[corners[2]] - leaf.vertices[corners[0]];
  return a.x() * b.y() - a.y() * b.x();
}

// Each entry by itself; a shape whose numbers were refused is not looked at as a whole.
LeafTemplate read_leaf(YamlMap& map) {
  LeafTemplate leaf;
  leaf.name = map.text("name");
  leaf.areal_density = map.number("areal_density", io::positive);
  if (const auto material = map.required("material")) leaf.material = read_material(*material);
  leaf.petiole_radius = map.number("petiole_radius", io::positive);
  leaf.vein_radius = map.number("vein_radius", io::positive);
  const auto vertices = map.required("vertices");
  const auto edges = map.required("edges");
  const auto triangles = map.required("triangles");
  map.finish();
  if (vertices) read_vertices(*vertices, leaf);
  if (leaf.vertices.empty()) return leaf;
  if (edges)
    for (const YamlNode& item : edges->list("edges")) read_edge(item, leaf);
  if (triangles)
    for (const YamlNode& item : triangles->list("triangles"))
      leaf.triangles.push_back(
          read_corners<3>(item, "a triangle", static_cast<int>(leaf.vertices.size())));
  return leaf;
}

// The order in which a breadth-first walk from the foot takes the edges: the spanning tree's, each
// turned so that it points away from the foot. `reached` marks the vertices it comes to.
struct TreeEdge {
  int edge = 0, from = 0, to = 0;
};
std::vector<TreeEdge> spanning_tree(const LeafTemplate& leaf, std::vector<bool>& reached) {
  std::vector<TreeEdge> tree;
  std::vector<int> queue{0};
  reached.assign(leaf.vertices.size(), false);
  reached[0] = true;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (std::size_t e = 0; e < leaf.edges.size(); ++e) {
      const auto [a, b] = leaf.edges[e];
      const int from = queue[next], to = a == from ? b : a;
      if ((a != from && b != from) || reached[to]) continue;
      reached[to] = true;
      queue.push_back(to);
      tree.push_back({static_cast<int>(e), from, to});
    }
  }
  return tree;
}

void check_vertices(const LeafTemplate& leaf, const YamlNode& node) {
  const std::vector<YamlNode> items = node.list("vertices");
  if (leaf.vertices.size() < 2) {
    node.error("vertices holds " + std::to_string(leaf.vertices.size()) + ", expected 2 or more");
    return;
  }
  if (leaf.vertices[0].norm() > 0.0)
    items[0].error("vertex 0 is the foot of the petiole, expected [0, 0]");
  double tip = 0.0;
  for (const Eigen::Vector2d& vertex : leaf.vertices) tip = std::max(tip, vertex.x());
  if (std::abs(tip - 1.0) > shortest)
    node.error("the largest x is " + std::to_string(tip) + ", expected 1: the tip of the leaf");
}

void check_edges(const LeafTemplate& leaf, const YamlNode& vertices, const YamlNode& edges) {
  const std::vector<YamlNode> items = edges.list("edges");
  for (std::size_t e = 0; e < leaf.edges.size(); ++e) {
    const auto [a, b] = leaf.edges[e];
    if ((leaf.vertices[a] - leaf.vertices[b]).norm() < shortest)
      items[e].error("the edge has no length, expected its ends at different places");
  }
  std::vector<bool> reached;
  spanning_tree(leaf, reached);
  const std::vector<YamlNode> places = vertices.list("vertices");
  for (std::size_t v = 0; v < reached.size(); ++v)
    if (!reached[v])
      places[v].error("no edges lead from the foot to vertex " + std::to_string(v) +
                      ", expected a connected leaf");
}

void check_triangles(const LeafTemplate& leaf, const YamlNode& node) {
  const std::vector<YamlNode> items = node.list("triangles");
  for (std::size_t t = 0; t < items.size(); ++t)
    if (!(twice_area(leaf, leaf.triangles[t]) > shortest * shortest))
      items[t].error("the triangle is flat or clockwise, expected its vertices anticlockwise");
}

std::optional<LeafTemplate> read(const YamlNode& node) {
  Diagnostics& diagnostics = node.diagnostics();
  const int before = diagnostics.error_count();
  YamlMap map(node, "a leaf template");
  if (!node.is_map() || !io::check_format(map, "pedicel-leaf", 1)) return std::nullopt;
  LeafTemplate leaf = read_leaf(map);
  const auto vertices = map.optional("vertices"), edges = map.optional("edges"),
             triangles = map.optional("triangles");
  if (diagnostics.error_count() == before) check_vertices(leaf, *vertices);
  if (diagnostics.error_count() == before) {
    check_edges(leaf, *vertices, *edges);
    check_triangles(leaf, *triangles);
  }
  if (diagnostics.error_count() > before) return std::nullopt;
  return leaf;
}

// Reads what `load` gives; a file that is not there or is no YAML is a fault like every other.
template <typename Load>
std::optional<LeafTemplate> read_from(Diagnostics& diagnostics, const Load& load) {
  const int before = diagnostics.error_count();
  try {
    auto leaf = read(load());
    return diagnostics.error_count() > before ? std::nullopt : leaf;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return std::nullopt;
  }
}

// Mass of the blade that each vertex carries (kg).
std::vector<double> blade_masses(const LeafTemplate& leaf, double size) {
  std::vector<double> mass(leaf.vertices.size(), 0.0);
  for (const std::array<int, 3>& corners : leaf.triangles)
    for (const int v : corners)
      mass[v] += leaf.areal_density * 0.5 * twice_area(leaf, corners) * size * size / 3.0;
  return mass;
}

cosserat::Weld weld_of(const cosserat::RodModel& model, int a, int b) {
  const cosserat::Element &first = model.elements[a], &second = model.elements[b];
  const auto half = [](const cosserat::Element& element) -> Vec3 {
    const cosserat::Section& s = element.section;
    return 0.5 * element.length * Vec3(s.bend1, s.bend2, s.twist).cwiseInverse();
  };
  cosserat::Weld weld;
  weld.a = a;
  weld.b = b;
  // So stiff that the gap is a thousandth of what the edge itself gives way.
  weld.position_stiffness = 1000.0 * second.section.axial / second.length;
  weld.bend_stiffness = (half(first) + half(second)).cwiseInverse();
  return weld;
}

}  // namespace

std::optional<LeafTemplate> parse_leaf_template(const std::string& text, const std::string& name,
                                                Diagnostics& diagnostics) {
  return read_from(diagnostics, [&] { return io::parse_yaml(text, name, diagnostics); });
}

std::optional<LeafTemplate> read_leaf_template(const std::filesystem::path& path,
                                               Diagnostics& diagnostics) {
  return read_from(diagnostics, [&] { return io::load_yaml(path, diagnostics); });
}

std::optional<std::filesystem::path> find_leaf_template(
    const std::string& name, const std::vector<std::filesystem::path>& folders) {
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path path = folder / (name + ".leaf.yaml");
    std::error_code unreadable;
    if (std::filesystem::is_regular_file(path, unreadable)) return path;
  }
  return std::nullopt;
}

Mat3 leaf_frame(const Vec3& normal, const std::optional<Vec3>& direction, const Vec3& tangent,
                int number) {
  constexpr double golden_angle = 2.399963;  // rad
  constexpr double parallel = 0.1;           // 1, sine
  const Vec3 z = normal.normalized();
  const Vec3 wanted = direction.value_or(tangent).normalized();
  const Vec3 across = wanted - wanted.dot(z) * z;
  Vec3 x = across.normalized();
  if (!(across.norm() > parallel))
    x = Eigen::AngleAxisd(number * golden_angle, z) * z.unitOrthogonal();
  Mat3 axes;
  axes << x, z.cross(x), z;
  return axes;
}

void grow_leaf(cosserat::RodModel& model, int parent, const Vec3& foot_W, const Mat3& axes_W,
               double size, const LeafTemplate& leaf, int organ,
               std::vector<BladeTriangle>& blades) {
  if (!(size > 0.0)) throw UsageError("a leaf's size = " + std::to_string(size) + ": must be > 0");
  const int first = model.size();
  const auto add_edge = [&](int edge, int from, int to) {
    const Vec3 end_W =
        foot_W + size * (axes_W * Vec3(leaf.vertices[to].x(), leaf.vertices[to].y(), 0.0));
    const double radius = size * leaf.edge_radius[edge];
    const int index = cosserat::add_element(
        model, from, end_W, cosserat::circle_section(radius, leaf.material), axes_W.col(2));
    cosserat::Element& element = model.elements[index];
    element.organ = organ;
    element.radius_near = element.radius_far = radius;
    element.damping_time = leaf.material.damping_time;
    return index;
  };

  std::vector<int> ending(leaf.vertices.size(), parent);  // the element that ends at a vertex
  std::vector<bool> in_tree(leaf.edges.size(), false), reached;
  for (const TreeEdge& tree : spanning_tree(leaf, reached)) {
    ending[tree.to] = add_edge(tree.edge, ending[tree.from], tree.to);
    in_tree[tree.edge] = true;
  }
  // A breadth-first tree holds every edge at the foot, so that both ends of a loop are elements.
  for (std::size_t e = 0; e < leaf.edges.size(); ++e) {
    if (in_tree[e]) continue;
    const auto [a, b] = leaf.edges[e];
    const int loop = add_edge(static_cast<int>(e), ending[a], b);
    model.welds.push_back(weld_of(model, ending[b], loop));
  }

  const auto place = [&](int v) {
    return v == 0 ? PlacedPoint{first, model.elements[first].length} : PlacedPoint{ending[v], 0.0};
  };
  const std::vector<double> mass = blade_masses(leaf, size);
  for (std::size_t v = 0; v < mass.size(); ++v) {
    const PlacedPoint at = place(static_cast<int>(v));
    if (mass[v] > 0.0) model.masses.push_back({at.element, at.back, mass[v], 0.0});
  }
  for (const auto& [a, b, c] : leaf.triangles) blades.push_back({{place(a), place(b), place(c)}});
}

}  // namespace pedicel::plant
