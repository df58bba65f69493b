#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pedicel::robot {

/// Where the files that a URDF names may lie. `package://NAME/rest` is looked up, in this order, in
/// the packages given by hand (`--package NAME=PATH`), under ROS_PACKAGE_PATH, under
/// AMENT_PREFIX_PATH (as PREFIX/share/NAME), and in the URDF's parent folders (a parent named NAME,
/// or one that contains NAME). `file://` and plain relative paths are taken from the URDF's folder.
class PackagePaths {
 public:
  /// Search folders as given, nothing from the environment.
  PackagePaths() = default;

  /// With ROS_PACKAGE_PATH and AMENT_PREFIX_PATH as they are set now.
  static PackagePaths from_environment();

  /// Adds "NAME=PATH". Throws UsageError where the text has another form.
  void add(const std::string& name_equals_path);
  void add_ros_path(const std::string& colon_separated);
  void add_ament_path(const std::string& colon_separated);

  struct Found {
    std::optional<std::filesystem::path> file;     ///< nothing where no candidate exists
    std::vector<std::filesystem::path> looked_at;  ///< every candidate, in order
  };
  /// Finds the file that `uri` names in a URDF.
  Found find(const std::string& uri, const std::filesystem::path& urdf) const;

 private:
  std::vector<std::filesystem::path> candidates(const std::string& name, const std::string& rest,
                                                const std::filesystem::path& urdf) const;

  std::map<std::string, std::filesystem::path> by_name_;
  std::vector<std::filesystem::path> ros_, ament_;
};

}  // namespace pedicel::robot
