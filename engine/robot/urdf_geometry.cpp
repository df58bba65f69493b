#include "robot/urdf_geometry.h"

namespace pedicel::robot {

Pose to_pose(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {{pose.position.x, pose.position.y, pose.position.z},
          Quat(r.w, r.x, r.y, r.z).normalized()};
}

void UrdfMeshes::read_mesh(const urdf::Mesh& source, Geometry& geometry) {
  geometry.kind = Geometry::Kind::mesh;
  const PackagePaths::Found found = packages_.find(source.filename, urdf_);
  if (!found.file) return;  // reported by check_links()
  geometry.mesh_file = *found.file;
  const Vec3 scale(source.scale.x, source.scale.y, source.scale.z);
  auto& mesh = loaded_[{found.file->string(), {scale.x(), scale.y(), scale.z()}}];
  if (mesh == nullptr) {
    try {
      mesh = std::make_shared<geometry::TriangleMesh>(geometry::load_mesh(*found.file, scale));
    } catch (const InvalidFile& fault) {
      diagnostics_.error(position_, "mesh \"" + source.filename + "\": " + fault.what());
      mesh = std::make_shared<geometry::TriangleMesh>();
    }
  }
  geometry.mesh = mesh;
}

Geometry UrdfMeshes::read(const urdf::Geometry& source) {
  Geometry geometry;
  switch (source.type) {
    case urdf::Geometry::BOX: {
      const auto& box = static_cast<const urdf::Box&>(source);
      geometry.kind = Geometry::Kind::box;
      geometry.size = {box.dim.x, box.dim.y, box.dim.z};
      break;
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(source);
      geometry.kind = Geometry::Kind::cylinder;
      geometry.radius = cylinder.radius;
      geometry.length = cylinder.length;
      break;
    }
    case urdf::Geometry::SPHERE:
      geometry.kind = Geometry::Kind::sphere;
      geometry.radius = static_cast<const urdf::Sphere&>(source).radius;
      break;
    case urdf::Geometry::MESH:
      read_mesh(static_cast<const urdf::Mesh&>(source), geometry);
      break;
  }
  return geometry;
}

Visual read_visual(const urdf::Visual& source, UrdfMeshes& meshes) {
  Visual visual;
  visual.X_LV = to_pose(source.origin);
  visual.geometry = meshes.read(*source.geometry);
  if (source.material != nullptr) {
    const urdf::Color& color = source.material->color;
    visual.color = {color.r, color.g, color.b, color.a};
  }
  return visual;
}

}  // namespace pedicel::robot
