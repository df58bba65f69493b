#pragma once

#include <map>
#include <memory>
#include <vector>

#include "engine/render/camera.h"
#include "engine/render/draw_list.h"
#include "engine/render/programs.h"
#include "engine/render/unit_meshes.h"

namespace pedicel::render {

/// Meshes in graphics memory, kept as long as their TriangleMesh lives.
class MeshCache {
 public:
  explicit MeshCache(const GlFunctions& gl) : gl_(gl) {}
  const InstancedMesh& get(const std::shared_ptr<const geometry::TriangleMesh>& mesh);
  /// Box around a cached mesh, in its own frame.
  const Eigen::AlignedBox3d& bounds(const std::shared_ptr<const geometry::TriangleMesh>& mesh);
  /// Gives back what belongs to meshes that are gone.
  void drop_unused();

 private:
  struct Entry {
    std::weak_ptr<const geometry::TriangleMesh> owner;
    std::unique_ptr<InstancedMesh> drawn;
    Eigen::AlignedBox3d box;
  };
  Entry& entry(const std::shared_ptr<const geometry::TriangleMesh>& mesh);

  const GlFunctions& gl_;
  std::map<const geometry::TriangleMesh*, Entry> entries_;  ///< looked up, never walked to draw
};

/// How finely to draw, and what may be left out.
class Detail {
 public:
  /// As a camera sees it in a picture of that size; `share` multiplies the pixels that count.
  Detail(const Camera& camera, int width, int height, double share = 1.0);
  /// Complete, for a parallel projection with that many pixels a metre: depth maps.
  explicit Detail(double pixels_per_metre) : everything_(true), focal_(pixels_per_metre) {}

  /// Level of detail of a ball, -1 where it is out of sight.
  int level(const Vec3& centre, double radius) const;
  /// The same for something that lies within `reach` of a point and is `radius` thick.
  int level(const Vec3& centre, double reach, double radius) const;

 private:
  bool everything_ = false;
  Eigen::Matrix<double, 3, 4> to_camera_ = Eigen::Matrix<double, 3, 4>::Zero();
  double focal_ = 0.0, near_ = 0.0, share_ = 1.0;
  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();  ///< half width, half height at distance 1
};

/// A draw list sorted into batches of equal shapes, and its way to the graphics memory.
class FrameGeometry {
 public:
  FrameGeometry(const GlFunctions& gl, const UnitMeshes& shapes, MeshCache& cache);
  ~FrameGeometry();
  FrameGeometry(const FrameGeometry&) = delete;
  FrameGeometry& operator=(const FrameGeometry&) = delete;

  void prepare(const DrawList& list, const Detail& detail);
  /// Draws all batches of a kind with the program in use. `cull` leaves out the back faces of
  /// closed meshes: in views that are not mirrored.
  void draw(Kind kind, bool cull = false) const;
  long triangles() const;

 private:
  struct Batch {
    const InstancedMesh* mesh = nullptr;
    std::vector<float> floats;
    std::size_t first = 0;  ///< in the buffer, floats
    int count() const { return static_cast<int>(floats.size()) / mesh->instance_floats(); }
  };

  std::vector<float>& batch(Kind kind, const InstancedMesh& mesh);
  void add_tubes(const DrawList& list, const Detail& detail);
  void add_capsules(const DrawList& list, const Detail& detail);
  void add_sphere(const Vec3& centre, double radius, const Shading& material, Label label,
                  const Detail& detail);
  void add_solids(const DrawList& list, const Detail& detail);
  void add_thin(const DrawList& list);
  void upload();

  const GlFunctions& gl_;
  const UnitMeshes& shapes_;
  MeshCache& cache_;
  std::vector<Batch> batches_[kind_count];
  std::vector<float> staging_;
  GLuint buffer_ = 0;
};

}  // namespace pedicel::render
