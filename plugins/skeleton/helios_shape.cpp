#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "plugins/skeleton/helios_plant.h"

namespace pedicel::plant {

namespace {

constexpr std::size_t most_helios_nodes = 1000000;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

Vec3 turned(const Vec3& direction, const Vec3& axis, double angle) {
  const double norm = axis.norm();
  if (norm < 1.0e-6 || angle == 0.0) return direction;
  return Eigen::AngleAxisd(angle, axis / norm) * direction;
}

/// What the next internode, the shoots and the petioles of a built internode need to know of it.
struct Built {
  int last = -1;               ///< node at its tip
  Vec3 tip = Vec3::Zero();     ///< in the file's unit
  Vec3 axis = Vec3::UnitZ();   ///< of its last tenth
  std::vector<Vec3> petioles;  ///< axes of their first tenth
  double phyllotaxis = 0.0;    ///< rad
};

/// A curve's direction over the first or the last tenth of its length.
Vec3 end_direction(const std::vector<Vec3>& points, bool at_tip, const Vec3& otherwise) {
  std::vector<Vec3> way = points;
  if (at_tip) std::reverse(way.begin(), way.end());
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).stableNorm();
  double left = 0.1 * length;
  Vec3 there = way.front();
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 step = way[i] - way[i - 1];
    const double size = step.stableNorm();
    there = size > left && size > 0.0 ? Vec3(way[i - 1] + step * (left / size)) : way[i];
    if (size > left) break;
    left -= size;
  }
  const Vec3 direction = at_tip ? Vec3(way.front() - there) : Vec3(there - way.front());
  const double norm = direction.stableNorm();
  return norm > 0.0 ? Vec3(direction / norm) : otherwise;
}

/// Where a shoot's node has no petiole, one is thought of, turned on by the angle between leaves.
Vec3 petiole_of(const Built& internode, int index, std::size_t number) {
  if (number < internode.petioles.size()) return internode.petioles[number];
  Vec3 axis = internode.axis.cross(Vec3::UnitZ());
  axis = axis.norm() < 0.01 ? Vec3(Vec3::UnitY()) : Vec3(axis.normalized());
  return turned(axis, internode.axis, index * internode.phyllotaxis);
}

class ShapeBuilder {
 public:
  ShapeBuilder(const HeliosPlant& plant, double unit, Diagnostics& diagnostics)
      : plant_(plant), unit_(unit), diagnostics_(diagnostics) {}

  std::vector<SkeletonNode> build() {
    const int before = diagnostics_.error_count();
    add_node(-1, plant_.base, std::nullopt, false, "base", plant_.where);
    for (const HeliosShoot& shoot : plant_.shoots) add_shoot(shoot);
    if (diagnostics_.error_count() > before) return {};
    return std::move(nodes_);
  }

 private:
  /// The axes from which an internode is turned, as Helios names them.
  struct Frame {
    Vec3 axis = Vec3::UnitZ(), petiole = -Vec3::UnitY();  ///< of what it stands on
    Vec3 internode = Vec3::UnitZ(), rotation = Vec3::UnitX();
  };

  int add_node(int parent, const Vec3& place, std::optional<double> radius, bool branch,
               const std::string& code, const SourcePosition& where) {
    if (nodes_.size() == most_helios_nodes)
      diagnostics_.error(where, "the plant goes on, expected at most " +
                                    std::to_string(most_helios_nodes) + " nodes");
    if (nodes_.size() >= most_helios_nodes) return parent;
    SkeletonNode node;
    node.parent = parent;
    node.position = unit_ * place;
    if (!node.position.allFinite())
      diagnostics_.repeated_error("place", where,
                                  "the plant goes on without end, expected lengths in m");
    if (radius && *radius > 0.0) node.diameter = 2.0 * unit_ * *radius;
    node.branch = branch;
    node.code = code;
    node.where = where;
    nodes_.push_back(std::move(node));
    return static_cast<int>(nodes_.size()) - 1;
  }

  // What a shoot stands on; nothing where that is not there.
  const Built* parent_of(const HeliosShoot& shoot) {
    const auto found = built_.find(shoot.parent);
    if (found == built_.end()) {
      diagnostics_.repeated_error("parent", shoot.where,
                                  "shoot " + std::to_string(shoot.id) + " hangs from shoot " +
                                      std::to_string(shoot.parent) +
                                      ", expected one that stands before it");
      return nullptr;
    }
    const std::vector<Built>& nodes = found->second;
    if (shoot.parent_node >= 0 && shoot.parent_node < static_cast<int>(nodes.size()))
      return &nodes[shoot.parent_node];
    diagnostics_.repeated_error("node", shoot.where,
                                "shoot " + std::to_string(shoot.id) + " hangs from phytomer " +
                                    std::to_string(shoot.parent_node) + ", expected one of the " +
                                    std::to_string(nodes.size()) + " of shoot " +
                                    std::to_string(shoot.parent) + ", counted from 0");
    return nullptr;
  }

  void add_shoot(const HeliosShoot& shoot) {
    if (built_.contains(shoot.id)) {
      diagnostics_.repeated_error(
          "twice", shoot.where,
          "shoot " + std::to_string(shoot.id) + " appears twice, expected it once");
      return;
    }
    Built base;
    base.last = 0;
    base.tip = plant_.base;
    Frame frame;
    if (shoot.parent >= 0) {
      const Built* parent = parent_of(shoot);
      if (parent == nullptr) return;
      base = *parent;
      frame.axis = base.axis;
      frame.petiole =
          petiole_of(base, shoot.parent_node, static_cast<std::size_t>(shoot.parent_petiole));
    }
    std::vector<Built> nodes;
    for (const HeliosInternode& internode : shoot.internodes) {
      if (nodes_.size() >= most_helios_nodes) return;
      const int index = static_cast<int>(nodes.size());
      if (index > 0) {
        base = nodes.back();
        frame.axis = base.axis;
        frame.petiole = petiole_of(base, index - 1, 0);
      }
      turn(frame, shoot, internode, index);
      nodes.push_back(add_internode(base, frame, shoot, internode, index));
    }
    built_.emplace(shoot.id, std::move(nodes));
  }

  static void turn(Frame& frame, const HeliosShoot& shoot, const HeliosInternode& internode,
                   int index) {
    const Vec3 across = frame.axis.cross(frame.petiole);
    frame.rotation = across.norm() < 1.0e-6 ? Vec3(Vec3::UnitX()) : Vec3(across.normalized());
    frame.internode = frame.axis;
    const double pitch = radians(internode.pitch);
    if (index > 0) {
      frame.internode = turned(frame.internode, frame.rotation, -1.25 * pitch);
      return;
    }
    frame.internode = turned(frame.internode, frame.rotation, 0.5 * pitch);
    const auto turn_both = [&frame](const Vec3& axis, double angle) {
      frame.rotation = turned(frame.rotation, axis, angle);
      frame.internode = turned(frame.internode, axis, angle);
    };
    turn_both(frame.axis, radians(shoot.roll));
    turn_both(-across, -radians(shoot.pitch));
    turn_both(frame.axis, radians(shoot.yaw));
  }

  // The base comes first.
  static std::vector<Vec3> places(const Built& base, const Frame& frame,
                                  const HeliosInternode& internode, int index) {
    std::vector<Vec3> points;
    if (!internode.vertices.empty()) {
      if (index > 0) points.push_back(base.tip);
      points.insert(points.end(), internode.vertices.begin(), internode.vertices.end());
      return points;
    }
    Vec3 axis = frame.internode;
    Vec3 bending = axis.cross(Vec3::UnitZ());
    bending = bending.norm() < 1.0e-6 ? Vec3(Vec3::UnitY()) : Vec3(bending.normalized());
    points.push_back(base.tip);
    const double step = internode.length / internode.segments;
    for (std::size_t i = 0; i < static_cast<std::size_t>(internode.segments); ++i) {
      if (index > 0 && i < internode.bend.size()) {
        axis = turned(axis, bending, radians(internode.bend[i]));
        if (i < internode.turn.size())
          axis = turned(axis, Vec3::UnitZ(), radians(internode.turn[i]));
      }
      points.push_back(points.back() + step * axis);
    }
    return points;
  }

  Built add_internode(const Built& base, const Frame& frame, const HeliosShoot& shoot,
                      const HeliosInternode& internode, int index) {
    const std::vector<Vec3> points = places(base, frame, internode, index);
    const std::string code = "shoot " + std::to_string(shoot.id);
    // Radii of older files belong to their vertices, which may begin with the base.
    const std::size_t shift = points.size() - internode.radii.size();
    int last = base.last;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const bool own = !internode.radii.empty() && i >= shift;
      last = add_node(last, points[i], own ? internode.radii[i - shift] : internode.radius,
                      i == 1 && index == 0 && (shoot.parent >= 0 || branches_from_base_), code,
                      internode.where);
    }
    if (shoot.parent < 0) branches_from_base_ = true;
    Built built;
    built.last = last;
    built.tip = points.back();
    built.axis = end_direction(points, true, frame.internode);
    built.phyllotaxis = radians(internode.phyllotaxis);
    for (std::size_t p = 0; p < internode.petioles.size(); ++p)
      built.petioles.push_back(add_petiole(built, frame, internode, index, p));
    return built;
  }

  // Its first direction comes back.
  Vec3 add_petiole(const Built& built, const Frame& frame, const HeliosInternode& internode,
                   int index, std::size_t number) {
    const HeliosPetiole& petiole = internode.petioles[number];
    Vec3 rotation = frame.rotation;
    Vec3 axis = turned(frame.internode, rotation, std::abs(radians(petiole.pitch)));
    const auto turn_both = [&](double angle) {
      axis = turned(axis, frame.internode, angle);
      rotation = turned(rotation, frame.internode, angle);
    };
    if (index > 0) turn_both(built.phyllotaxis);
    turn_both(2.0 * std::numbers::pi * static_cast<double>(number) /
              static_cast<double>(internode.petioles.size()));
    const Vec3 first = axis;
    const double step = petiole.length / petiole.segments;
    std::vector<Vec3> points = {built.tip};
    int last = built.last;
    for (int s = 1; s <= petiole.segments; ++s) {
      axis = turned(axis, rotation, -radians(petiole.curvature * step));
      points.push_back(points.back() + step * axis);
      if (petiole.length <= 0.0) continue;
      const double left = 1.0 - petiole.taper * s / petiole.segments;
      last = add_node(last, points.back(), petiole.scale * petiole.radius * left, s == 1, "petiole",
                      petiole.where);
    }
    return end_direction(points, false, first);
  }

  const HeliosPlant& plant_;
  double unit_;
  Diagnostics& diagnostics_;
  std::vector<SkeletonNode> nodes_;
  std::unordered_map<int, std::vector<Built>> built_;  ///< internodes of the shoots so far
  bool branches_from_base_ = false;
};

}  // namespace

std::vector<SkeletonNode> helios_nodes(const HeliosPlant& plant, double unit,
                                       Diagnostics& diagnostics) {
  return ShapeBuilder(plant, unit, diagnostics).build();
}

}  // namespace pedicel::plant
