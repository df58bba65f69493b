#pragma once

#include <urdf_model/link.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/diagnostics.h"
#include "robot/description.h"
#include "robot/package_paths.h"

namespace pedicel::robot {

Pose to_pose(const urdf::Pose& pose);

/// Turns urdfdom's shapes into ours and loads each mesh file once per scale.
class UrdfMeshes {
 public:
  UrdfMeshes(std::filesystem::path urdf, const PackagePaths& packages, Diagnostics& diagnostics)
      : urdf_(std::move(urdf)), packages_(packages), diagnostics_(diagnostics) {}

  /// Where faults of the meshes read from now on are reported.
  void set_position(SourcePosition position) { position_ = std::move(position); }

  /// A mesh that cannot be loaded is reported, and its geometry comes back empty.
  Geometry read(const urdf::Geometry& source);

 private:
  void read_mesh(const urdf::Mesh& source, Geometry& geometry);

  std::filesystem::path urdf_;
  const PackagePaths& packages_;
  Diagnostics& diagnostics_;
  SourcePosition position_;
  using Key = std::pair<std::string, std::array<double, 3>>;
  std::map<Key, std::shared_ptr<const geometry::TriangleMesh>> loaded_;
};

Visual read_visual(const urdf::Visual& source, UrdfMeshes& meshes);

}  // namespace pedicel::robot
