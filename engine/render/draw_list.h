#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/frames.h"
#include "engine/geometry/mesh.h"

namespace pedicel::render {

/// A colour as people write it: sRGB, each part in [0, 1].
struct Colour {
  float r = 0.8f, g = 0.8f, b = 0.8f;

  /// 0xRRGGBB.
  static constexpr Colour hex(std::uint32_t rgb) {
    return {static_cast<float>((rgb >> 16) & 255u) / 255.0f,
            static_cast<float>((rgb >> 8) & 255u) / 255.0f,
            static_cast<float>(rgb & 255u) / 255.0f};
  }
};

/// How a surface takes the light.
struct Shading {
  Colour colour;
  float roughness = 0.6f;  ///< 0.1 polished .. 1 chalk
  float specular = 0.5f;   ///< strength of the highlight, 0 .. 1
};

/// A named set of materials, so that every scene has the same readable colours.
namespace shadings {
inline constexpr Shading stem{Colour::hex(0x6b8f3a), 0.6f, 0.35f};
inline constexpr Shading wood{Colour::hex(0x7a5a3c), 0.85f, 0.2f};
inline constexpr Shading leaf{Colour::hex(0x4f8f36), 0.55f, 0.3f};
inline constexpr Shading tomato{Colour::hex(0xd7301f), 0.22f, 0.8f};
inline constexpr Shading apple{Colour::hex(0xb9262b), 0.3f, 0.7f};
inline constexpr Shading robot_light{Colour::hex(0xe4e6e8), 0.4f, 0.5f};
inline constexpr Shading robot_dark{Colour::hex(0x3a3f46), 0.45f, 0.5f};
inline constexpr Shading accent{Colour::hex(0xe8862d), 0.45f, 0.5f};
inline constexpr Shading steel{Colour::hex(0x9aa3ab), 0.3f, 0.8f};
}  // namespace shadings

/// What a thing is called in a label map (label_map.h), so that a picture can tell one from
/// another: 0 for what has no name. Below 2^24.
using Label = std::uint32_t;

/// Two spheres and the cone that touches both (the convex hull). World frame, m.
struct Capsule {
  Vec3 p0, p1;
  double r0 = 0.0, r1 = 0.0;
  Shading material;
  Label label = 0;
};

/// One stretch of a smooth tube between two neighbouring points of a chain; made by
/// DrawList::add_tube(). World frame, m.
struct TubeSegment {
  Vec3 p0, p1;              ///< ends of the centreline
  Vec3 tangent0, tangent1;  ///< unit, shared with the neighbouring stretch
  Vec3 side0, side1;        ///< unit, across the tangents; carried along the chain without twist
  double r0 = 0.0, r1 = 0.0;
  Colour colour0, colour1;
  float roughness = 0.6f, specular = 0.35f;
  bool rounded = false;  ///< closed by half spheres: the first and the last stretch of a chain
  Label label = 0;
};

/// A point of a stem's centreline, as DrawList::add_tube() takes it. World frame, m.
struct TubePoint {
  Vec3 position;
  double radius = 0.0;
  Colour colour;
};

struct Sphere {
  Vec3 centre;  ///< W, m
  double radius = 0.0;
  Shading material;
  Label label = 0;
};

struct Box {
  Pose pose;          ///< box to world
  Vec3 half_extents;  ///< m
  Shading material;
  Label label = 0;
};

/// A mesh drawn at a pose. The renderer keeps its buffers as long as the same mesh object lives, so
/// share one object between frames.
struct MeshInstance {
  std::shared_ptr<const geometry::TriangleMesh> mesh;
  Pose pose;  ///< mesh to world
  Shading material;
  Label label = 0;
};

/// A flat triangle seen and lit from both sides, letting some light through: a leaf blade.
struct BladeFace {
  Vec3 a, b, c;  ///< W, m
  Shading material;
  Label label = 0;
};

/// An unlit line of constant width on the screen. World frame.
struct Line {
  Vec3 a, b;
  Colour colour;
  float width = 1.5f;  ///< px
};

/// The floor: a soft checker that fades into the horizon.
struct Ground {
  double height = 0.0;  ///< z, W, m
  double cell = 0.25;   ///< side of a checker field, m
  Colour light = Colour::hex(0xdcd9d2);
  Colour dark = Colour::hex(0xd0ccc3);
  Label label = 0;
};

/// Everything that one picture shows; plain data without any OpenGL. Fill it anew for every frame
/// (clear() keeps the memory).
class DrawList {
 public:
  std::vector<Capsule> capsules;
  std::vector<TubeSegment> tubes;
  std::vector<Sphere> spheres;
  std::vector<Box> boxes;
  std::vector<MeshInstance> meshes;
  std::vector<BladeFace> blades;
  std::vector<Line> lines;
  std::optional<Ground> ground = Ground{};
  /// Drawn over the rest, half transparent as one thing (nothing of it shows through itself),
  /// behind what stands before it, without a shadow. Its own ground and ghost are left out. Null:
  /// none.
  std::shared_ptr<const DrawList> ghost;
  float ghost_opacity = 0.4f;  ///< 1, of the ghost: 0 unseen, 1 solid

  /// A stem: a smooth tube through all points (cubic Hermite with the neighbours' mean directions
  /// as tangents), rounded at both ends. Points that coincide are taken as one; a single point is a
  /// sphere; none draws nothing.
  void add_tube(std::span<const TubePoint> points, float roughness = 0.6f, float specular = 0.35f);

  /// A shaft with a cone at its tip, from tail to tip (forces). Shorter than 1 um: nothing.
  void add_arrow(const Vec3& tail, const Vec3& tip, double radius, const Shading& material);

  /// Empties the list and keeps its memory; the ground stays.
  void clear();

  /// How many there are of each shape, to label what is added after.
  struct Counts {
    std::size_t capsules = 0, tubes = 0, spheres = 0, boxes = 0, meshes = 0, blades = 0;
  };
  Counts counts() const;
  /// Gives what was added since a label; the ground and the ghost are left out.
  void label_since(const Counts& before, Label label);

  /// Encloses everything but the ground and the ghost; empty where nothing is drawn. W, m.
  Eigen::AlignedBox3d bounds() const;
};

/// Encloses a mesh in its own frame; empty for an empty mesh.
Eigen::AlignedBox3d mesh_bounds(const geometry::TriangleMesh& mesh);

}  // namespace pedicel::render
