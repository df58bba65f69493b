#include "engine/urdf/package_paths.h"

#include <charconv>
#include <cstdlib>
#include <sstream>

#include "engine/core/check.h"
#include "engine/urdf/file_in_other_case.h"

namespace pedicel::robot {

namespace fs = std::filesystem;

namespace {

void split_paths(const std::string& text, std::vector<fs::path>& paths) {
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ':');)
    if (!item.empty()) paths.emplace_back(item);
}

/// What a mesh's name says: a path, and the package that it counts from, if any.
struct MeshName {
  std::string package, path;
};

MeshName parse_name(std::string text) {
  for (const char* scheme : {"package://", "model://"}) {
    if (!text.starts_with(scheme)) continue;
    text.erase(0, std::string(scheme).size());
    text.erase(0, text.find_first_not_of('/'));  // package:///NAME is written, too
    const auto slash = text.find('/');
    if (slash == std::string::npos) return {text, ""};
    return {text.substr(0, slash), text.substr(slash + 1)};
  }
  for (const char* scheme : {"file://localhost/", "file://"})
    if (text.starts_with(scheme)) {
      text.erase(0, std::string(scheme).size() - (text.starts_with("file://l") ? 1 : 0));
      break;
    }
  return {"", text};
}

std::string with_slashes(std::string text) {
  for (char& c : text)
    if (c == '\\') c = '/';
  return text;
}

/// %20 and its like as the characters that they stand for.
std::string without_percent(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    int code = 0;
    const bool coded = text[i] == '%' && i + 2 < text.size() &&
                       std::from_chars(&text[i + 1], &text[i] + 3, code, 16).ptr == &text[i] + 3;
    plain += coded ? static_cast<char>(code) : text[i];
    if (coded) i += 2;
  }
  return plain;
}

/// As written first, then as another system would have meant it.
std::vector<std::string> readings(const std::string& uri) {
  std::vector<std::string> all = {uri};
  for (const std::string& other : {with_slashes(uri), without_percent(with_slashes(uri))})
    if (other != all.back()) all.push_back(other);
  return all;
}

}  // namespace

PackagePaths PackagePaths::from_environment() {
  PackagePaths paths;
  for (const char* variable : {"ROS_PACKAGE_PATH", "GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH"})
    if (const char* folders = std::getenv(variable)) paths.add_ros_path(folders);
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

/// Says where the folder of a package was found, or how to name it.
std::string PackagePaths::package_advice(const std::string& name, const fs::path& urdf) const {
  std::error_code error;
  for (const fs::path& folder : candidates(name, "", urdf))
    if (fs::is_directory(folder, error))
      return "the package is in " + folder.parent_path().string() + ", without that file";
  if (by_name_.contains(name)) return "--package " + name + "=PATH names no folder";
  return "say where the package is with --package " + name + "=PATH";
}

PackagePaths::Found PackagePaths::find(const std::string& uri, const fs::path& urdf) const {
  Found result;
  for (const std::string& reading : readings(uri)) {
    const MeshName name = parse_name(reading);
    const bool packaged = reading.starts_with("package://") || reading.starts_with("model://");
    const std::vector<fs::path> places =
        packaged ? candidates(name.package, name.path, urdf)
                 : std::vector{urdf.parent_path() / name.path};  // absolute: replaces the folder
    result.package = name.package;
    std::error_code error;
    for (const fs::path& candidate : places) {
      if (!result.file && fs::is_regular_file(candidate, error)) result.file = candidate;
      result.looked_at.push_back(candidate);
    }
    if (result.file) return result;
    if (packaged)
      result.advice = name.path.empty()
                          ? "expected " + reading.substr(0, reading.find('/')) + "//NAME/FILE"
                          : package_advice(name.package, urdf);
  }
  for (const fs::path& candidate : result.looked_at)
    if (!result.file) result.file = file_in_other_case(candidate);
  result.other_case = result.file.has_value();
  return result;
}

}  // namespace pedicel::robot
