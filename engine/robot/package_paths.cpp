#include "robot/package_paths.h"

#include <cstdlib>
#include <sstream>

#include "core/check.h"

namespace pedicel::robot {

namespace fs = std::filesystem;

namespace {

void split_paths(const std::string& text, std::vector<fs::path>& paths) {
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ':');)
    if (!item.empty()) paths.emplace_back(item);
}

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

}  // namespace

PackagePaths PackagePaths::from_environment() {
  PackagePaths paths;
  if (const char* ros = std::getenv("ROS_PACKAGE_PATH")) paths.add_ros_path(ros);
  if (const char* ament = std::getenv("AMENT_PREFIX_PATH")) paths.add_ament_path(ament);
  return paths;
}

void PackagePaths::add(const std::string& name_equals_path) {
  const auto equals = name_equals_path.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == name_equals_path.size())
    throw UsageError("package \"" + name_equals_path + "\": expected NAME=PATH");
  by_name_[name_equals_path.substr(0, equals)] = name_equals_path.substr(equals + 1);
}

void PackagePaths::add_ros_path(const std::string& colon_separated) {
  split_paths(colon_separated, ros_);
}

void PackagePaths::add_ament_path(const std::string& colon_separated) {
  split_paths(colon_separated, ament_);
}

std::vector<fs::path> PackagePaths::candidates(const std::string& name, const std::string& rest,
                                               const fs::path& urdf) const {
  std::vector<fs::path> found;
  if (const auto given = by_name_.find(name); given != by_name_.end())
    return {given->second / rest};  // said by hand: no other place is meant
  for (const fs::path& path : ros_) {
    found.push_back(path / name / rest);
    if (path.filename() == name) found.push_back(path / rest);
  }
  for (const fs::path& path : ament_) found.push_back(path / "share" / name / rest);
  for (fs::path parent = fs::absolute(urdf).lexically_normal().parent_path();;
       parent = parent.parent_path()) {
    if (parent.filename() == name) found.push_back(parent / rest);
    found.push_back(parent / name / rest);
    if (parent == parent.root_path()) return found;
  }
}

PackagePaths::Found PackagePaths::find(const std::string& uri, const fs::path& urdf) const {
  static const std::string package = "package://", file = "file://";
  Found result;
  if (starts_with(uri, package)) {
    const std::string path = uri.substr(package.size());
    const auto slash = path.find('/');
    const std::string rest = slash == std::string::npos ? "" : path.substr(slash + 1);
    result.looked_at = candidates(path.substr(0, slash), rest, urdf);
  } else {
    const fs::path path = starts_with(uri, file) ? uri.substr(file.size()) : uri;
    result.looked_at = {urdf.parent_path() / path};  // an absolute path replaces the folder
  }
  std::error_code error;
  for (const fs::path& candidate : result.looked_at)
    if (!result.file && fs::is_regular_file(candidate, error)) result.file = candidate;
  return result;
}

}  // namespace pedicel::robot
