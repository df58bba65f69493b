#include "plugins/plant/plant_export.h"

#include <algorithm>
#include <cmath>

#include "engine/io/csv.h"
#include "plugins/plant/plant_graph.h"
#include "plugins/plant/stem_tree.h"

namespace pedicel::plant {

namespace {

constexpr double pi = 3.14159265358979323846;

std::string number(double value) {
  return io::exact_number(value);
}

std::string row(const Vec3& v, const char* between) {
  return number(v.x()) + between + number(v.y()) + between + number(v.z());
}

constexpr double same_arc = 1.0e-6;         // m
constexpr double chord_tolerance = 2.0e-4;  // m, of straight rows from a smooth curve

double chord_error(const geometry::Curve& curve, double from, double to) {
  const Vec3 middle = 0.5 * (curve.point(from) + curve.point(to));
  return (curve.point(0.5 * (from + to)) - middle).norm();
}

/// Arc lengths of the control points, and between them as many as a chord needs to stay near.
std::vector<double> row_arcs(const geometry::Curve& curve) {
  std::vector<double> arcs;
  for (int i = 0; i + 1 < curve.control_points(); ++i) {
    const double from = curve.control_arc(i), whole = curve.control_arc(i + 1) - from;
    const auto worst = [&](int parts) {
      double error = 0.0;
      for (int k = 0; k < parts; ++k)
        error = std::max(
            error, chord_error(curve, from + whole * k / parts, from + whole * (k + 1) / parts));
      return error;
    };
    int parts = 1;
    while (parts < 64 && worst(parts) > chord_tolerance) parts *= 2;
    for (int k = 0; k < parts; ++k) arcs.push_back(from + whole * k / parts);
  }
  arcs.push_back(curve.length());
  return arcs;
}

/// Writes the rows of a skeleton table, parents first.
class SkeletonWriter {
 public:
  explicit SkeletonWriter(const PlantFile& plant)
      : plant_(plant), tree_(stem_tree(plant)), curves_(make_curves(plant)) {}

  std::string text() {
    for (const geometry::Curve& curve : curves_) arcs_.push_back(row_arcs(curve));
    add_feet();
    for (std::size_t c = 0; c < tree_.size(); ++c) {
      if (!tree_[c].joined || tree_[c].parent >= 0) continue;
      add_curve(static_cast<int>(c));
      for (const int branch : branches_of(tree_, static_cast<int>(c))) add_curve(branch);
    }
    return "x,y,z,parentid,vid,edgetype,diameter_m\n" + rows_;
  }

 private:
  double foot_arc(int c) const { return tree_[c].parent_at * curves_[tree_[c].parent].length(); }

  // A row of the parent for each branch: a table cannot say that one begins between two rows.
  void add_feet() {
    for (std::size_t c = 0; c < tree_.size(); ++c) {
      if (!tree_[c].joined || tree_[c].parent < 0) continue;
      std::vector<double>& arcs = arcs_[tree_[c].parent];
      const double foot = foot_arc(static_cast<int>(c));
      const auto is_foot = [foot](double arc) { return std::abs(arc - foot) < same_arc; };
      if (std::ranges::none_of(arcs, is_foot))
        arcs.insert(std::ranges::lower_bound(arcs, foot), foot);
    }
  }

  // As the drawing has them where there is a control point.
  Vec3 place(int c, double arc) const {
    for (int i = 0; i < curves_[c].control_points(); ++i)
      if (std::abs(curves_[c].control_arc(i) - arc) < same_arc) return plant_.curves[c].points[i];
    return curves_[c].point(arc);
  }

  // A branch begins on its parent's centre line, where building joins it, with its own radius.
  void add_curve(int c) {
    std::vector<double> arcs = arcs_[c];
    if (!tree_[c].foot_first) std::ranges::reverse(arcs);
    const Id* foot = tree_[c].parent < 0 ? nullptr : nearest(tree_[c].parent, foot_arc(c));
    int parent = foot ? foot->id : -1;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const bool begins = i == 0 && foot;
      const Vec3 at = begins ? place(foot->curve, foot->arc) : place(c, arcs[i]);
      rows_ += row(at, ",") + "," + (parent < 0 ? "" : std::to_string(parent)) + "," +
               std::to_string(next_) + "," + (begins ? "+" : "<") + "," +
               number(2.0 * curves_[c].radius(arcs[i])) + "\n";
      parent = next_++;
      ids_.push_back({c, arcs[i], parent});
      if (begins) foot = nullptr;
    }
  }

  struct Id {
    int curve;
    double arc;  // m
    int id;
  };

  // Null where the parent has no rows.
  const Id* nearest(int parent, double arc) const {
    const Id* best = nullptr;
    for (const Id& one : ids_)
      if (one.curve == parent && (!best || std::abs(one.arc - arc) < std::abs(best->arc - arc)))
        best = &one;
    return best;
  }

  const PlantFile& plant_;
  std::vector<StemJoint> tree_;
  std::vector<geometry::Curve> curves_;
  std::vector<std::vector<double>> arcs_;  // m, of each curve's rows
  std::vector<Id> ids_;
  std::string rows_;
  int next_ = 0;
};

/// A direction across another one.
Vec3 across(const Vec3& along) {
  return along.cross(std::abs(along.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX()).normalized();
}

/// Tubes and spheres, one after another.
class MeshMaker {
 public:
  explicit MeshMaker(int sides) : sides_(sides) {}

  void add_tube(const std::string& name, const geometry::Curve& curve) {
    begin(name);
    Vec3 side = across(curve.tangent(0.0)), tangent = curve.tangent(0.0);
    const std::vector<double> arcs = curve.sample_arcs(std::max(1.0e-3, curve.length() / 64.0));
    for (const double arc : arcs) {
      const Vec3 now = curve.tangent(arc);
      side = Quat::FromTwoVectors(tangent, now) * side;
      side = (side - side.dot(now) * now).normalized();
      tangent = now;
      add_ring(curve.point(arc), now, side, curve.radius(arc));
    }
    const int rings = static_cast<int>(arcs.size());
    for (int r = 0; r + 1 < rings; ++r) join_rings(first_point_ + r * sides_);
    add_cap(curve.point(0.0), -curve.tangent(0.0), first_point_, true);
    add_cap(curve.point(curve.length()), curve.tangent(curve.length()),
            first_point_ + (rings - 1) * sides_, false);
  }

  void add_sphere(const std::string& name, const Vec3& centre, double radius) {
    begin(name);
    const int rings = std::max(4, sides_ / 2);
    for (int r = 0; r <= rings; ++r)
      for (int s = 0; s < sides_; ++s) {
        const double polar = pi * r / rings, turn = 2.0 * pi * s / sides_;
        const Vec3 n(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                     -std::cos(polar));
        mesh.points.push_back(centre + radius * n);
        mesh.normals.push_back(n);
      }
    for (int r = 0; r < rings; ++r) join_rings(first_point_ + r * sides_, r == 0, r + 1 == rings);
  }

  PlantMesh mesh;

 private:
  void begin(const std::string& name) {
    first_point_ = static_cast<int>(mesh.points.size());
    mesh.parts.push_back({name, static_cast<int>(mesh.triangles.size())});
  }

  void add_ring(const Vec3& centre, const Vec3& along, const Vec3& side, double radius) {
    const Vec3 other = along.cross(side);
    for (int s = 0; s < sides_; ++s) {
      const double turn = 2.0 * pi * s / sides_;
      const Vec3 n = std::cos(turn) * side + std::sin(turn) * other;
      mesh.points.push_back(centre + radius * n);
      mesh.normals.push_back(n);
    }
  }

  // A pole has triangles of no area on one side: those are left out.
  void join_rings(int first, bool from_pole = false, bool to_pole = false) {
    for (int s = 0; s < sides_; ++s) {
      const int a = first + s, b = first + (s + 1) % sides_;
      if (!from_pole) mesh.triangles.push_back({a, b, a + sides_});
      if (!to_pole) mesh.triangles.push_back({b, b + sides_, a + sides_});
    }
  }

  void add_cap(const Vec3& centre, const Vec3& outward, int ring, bool at_foot) {
    const int middle = static_cast<int>(mesh.points.size());
    mesh.points.push_back(centre);
    mesh.normals.push_back(outward);
    for (int s = 0; s < sides_; ++s) {
      const int a = ring + s, b = ring + (s + 1) % sides_;
      mesh.triangles.push_back(at_foot ? std::array{middle, b, a} : std::array{middle, a, b});
    }
  }

  int sides_, first_point_ = 0;
};

}  // namespace

std::string skeleton_text(const PlantFile& plant) {
  return SkeletonWriter(plant).text();
}

PlantMesh tube_mesh(const PlantFile& plant, int sides) {
  MeshMaker maker(sides);
  const std::vector<geometry::Curve> curves = make_curves(plant);
  for (std::size_t c = 0; c < curves.size(); ++c) maker.add_tube(plant.curves[c].name, curves[c]);
  for (const PlantFruit& fruit : plant.fruits) {
    const geometry::Curve& curve = curves[plant.curve_index(fruit.place.curve)];
    maker.add_sphere(fruit.name, curve.point(fruit.place.at * curve.length()), fruit.radius);
  }
  return std::move(maker.mesh);
}

std::string obj_text(const PlantMesh& mesh, const std::string& name) {
  std::string text = "# " + name + ", m, Z up\n";
  for (const Vec3& point : mesh.points) text += "v " + row(point, " ") + "\n";
  for (const Vec3& normal : mesh.normals) text += "vn " + row(normal, " ") + "\n";
  std::size_t part = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    while (part < mesh.parts.size() && mesh.parts[part].first_triangle == static_cast<int>(t))
      text += "o " + mesh.parts[part++].name + "\n";
    text += "f";
    for (const int corner : mesh.triangles[t])
      text += " " + std::to_string(corner + 1) + "//" + std::to_string(corner + 1);
    text += "\n";
  }
  return text;
}

std::string ply_text(const PlantMesh& mesh) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.points.size()) + "\n";
  for (const char* property : {"x", "y", "z", "nx", "ny", "nz"})
    text += std::string("property double ") + property + "\n";
  text += "element face " + std::to_string(mesh.triangles.size()) +
          "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    text += row(mesh.points[i], " ") + " " + row(mesh.normals[i], " ") + "\n";
  for (const auto& t : mesh.triangles)
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) +
            "\n";
  return text;
}

}  // namespace pedicel::plant
