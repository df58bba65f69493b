#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pedicel::robot {

/// Where the files that a URDF names may lie. `package://NAME/rest` and `model://NAME/rest` are
/// looked up, in this order, in the packages given by hand (`--package NAME=PATH`), under
/// ROS_PACKAGE_PATH, GAZEBO_MODEL_PATH and GZ_SIM_RESOURCE_PATH, under AMENT_PREFIX_PATH (as
/// PREFIX/share/NAME), and in the URDF's parent folders (a parent named NAME, or one that contains
/// NAME). `file://` and plain relative paths are taken from the URDF's folder. What is written in
/// the way of another system is read where nothing lies under the name as written: `\` between
/// folders, `%20`, and a name that differs in upper and lower case only.
class PackagePaths {
 public:
  /// Search folders as given, nothing from the environment.
  PackagePaths() = default;

  /// With the variables above as they are set now.
  static PackagePaths from_environment();

  /// Adds "NAME=PATH". Throws UsageError where the text has another form.
  void add(const std::string& name_equals_path);
  void add_ros_path(const std::string& colon_separated);
  void add_ament_path(const std::string& colon_separated);

  struct Found {
    std::optional<std::filesystem::path> file;     ///< nothing where no candidate exists
    std::vector<std::filesystem::path> looked_at;  ///< every candidate, in order
    bool other_case = false;  ///< the file's name differs in upper and lower case
    std::string package;      ///< that the name states; empty: none
    /// What to do about a file that was not found, after a semicolon; empty where nothing is known.
    std::string advice;
  };
  /// Finds the file that `uri` names in a URDF.
  Found find(const std::string& uri, const std::filesystem::path& urdf) const;

 private:
  std::vector<std::filesystem::path> candidates(const std::string& name, const std::string& rest,
                                                const std::filesystem::path& urdf) const;
  std::string package_advice(const std::string& name, const std::filesystem::path& urdf) const;

  std::map<std::string, std::filesystem::path> by_name_;
  std::vector<std::filesystem::path> ros_, ament_;
};

}  // namespace pedicel::robot
