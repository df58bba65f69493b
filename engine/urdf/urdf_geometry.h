#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/robot/description.h"
#include "engine/urdf/missing_meshes.h"
#include "engine/urdf/package_paths.h"
#include "engine/urdf/urdf_remarks.h"
#include "engine/urdf/urdf_xml.h"

namespace pedicel::robot {

/// The pose of an element's <origin>: position and roll, pitch, yaw, or (URDF 1.1) quat_xyzw. The
/// identity where there is none. The element has been checked.
Pose read_origin(const UrdfXml& xml, const TiXmlElement& parent);

/// Reads checked shapes from the XML (urdfdom 3.0 knows no capsules) and loads each mesh file once
/// per scale.
class UrdfShapes {
 public:
  UrdfShapes(const UrdfXml& xml, const PackagePaths& packages, UrdfRemarks& remarks)
      : xml_(xml), packages_(packages), remarks_(remarks) {}

  /// The shape of a <visual> or <collision> of a link. Nothing where it has no extent or its mesh
  /// is missing: that is kept for the warnings. A collision mesh that is there and cannot be read
  /// is an error.
  std::optional<Geometry> read(const TiXmlElement& owner, const std::string& link);

  const std::vector<MissingMesh>& missing() const { return missing_; }

 private:
  std::optional<Geometry> read_mesh(const TiXmlElement& mesh, const std::string& link,
                                    bool collision);
  struct Loaded {
    std::shared_ptr<const geometry::TriangleMesh> mesh;
    std::string fault;  ///< why there is no mesh
  };
  const Loaded& load(const std::filesystem::path& file, const Vec3& scale);

  const UrdfXml& xml_;
  const PackagePaths& packages_;
  UrdfRemarks& remarks_;
  std::vector<MissingMesh> missing_;
  std::map<std::string, Loaded> loaded_;              ///< by file and scale
  std::map<std::string, PackagePaths::Found> found_;  ///< by name: looking takes many system calls
};

}  // namespace pedicel::robot
