#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/geometry/mesh.h"

namespace pedicel::robot {

/// The shape of a visual or a collision, in its own frame. The axis of a cylinder or
/// capsule is z; all but meshes are centred on the frame's origin.
struct Geometry {
  enum class Kind { box, cylinder, sphere, capsule, mesh };
  Kind kind = Kind::box;
  Vec3 size = Vec3::Zero();                            ///< box: full extents, m
  double radius = 0.0;                                 ///< cylinder, sphere and capsule, m
  double length = 0.0;                                 ///< cylinder; capsule without its caps, m
  std::filesystem::path mesh_file;                     ///< mesh: where it was found
  std::shared_ptr<const geometry::TriangleMesh> mesh;  ///< mesh: scaled, m
};

struct Visual {
  Pose X_LV;  ///< in the link's frame
  Geometry geometry;
  Eigen::Vector4d color{0.7, 0.7, 0.7, 1.0};  ///< red, green, blue, alpha in 0..1
};

struct Collision {
  Pose X_LC;  ///< in the link's frame
  Geometry geometry;
};

/// Mass properties: inertia about the centre of mass, along the link's axes.
struct Inertial {
  double mass = 0.0;            ///< kg
  Vec3 com_L = Vec3::Zero();    ///< m
  Mat3 inertia = Mat3::Zero();  ///< kg m2
};

struct Link {
  std::string name;
  Inertial inertial;  ///< zero mass: a mere frame (fixed to its parent, without geometry)
  std::vector<Visual> visuals;
  std::vector<Collision> collisions;
};

/// position = multiplier * (position of joint `source`) + offset. Never refers to another mimic
/// joint: the reader resolves chains.
struct Mimic {
  int source = -1;
  double multiplier = 1.0;
  double offset = 0.0;  ///< rad or m
};

enum class JointType { fixed, revolute, continuous, prismatic };

/// Units are rad, N m for turning joints, m, N for sliding ones.
struct Joint {
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  std::string name;
  JointType type = JointType::fixed;
  int parent = -1;              ///< index of the parent link
  int child = -1;               ///< index of the child link
  Pose X_PJ;                    ///< joint frame (= child frame at position 0) in the parent's frame
  Vec3 axis = Vec3::UnitX();    ///< unit, in the joint's frame
  double lower = -unlimited;    ///< rad or m
  double upper = unlimited;     ///< rad or m
  double effort = unlimited;    ///< N m or N, largest of the motor
  double velocity = unlimited;  ///< rad/s or m/s, largest commanded
  double damping = 0.0;         ///< N m s/rad or N s/m
  double friction = 0.0;        ///< N m or N, Coulomb
  std::optional<Mimic> mimic;

  bool moves() const { return type != JointType::fixed; }
};

/// A robot as its URDF states it: a tree of links, in the order of the file. Holds no Bullet
/// object.
struct RobotDescription {
  std::string name;
  std::string file;
  std::vector<Link> links;
  std::vector<Joint> joints;
  int root = -1;  ///< index of the link that has no parent

  /// Index of a link or joint by its name in the URDF, -1 where there is none.
  int link(const std::string& link_name) const;
  int joint(const std::string& joint_name) const;
};

}  // namespace pedicel::robot
