#include "engine/robot/read/read_robot.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "engine/io/text_file.h"
#include "engine/urdf/urdf_reader.h"

namespace pedicel::robot {

namespace {

struct Format {
  std::string name;
  std::vector<std::string> extensions;  ///< in lower case
  std::string element;                  ///< of its text, with the bracket
  decltype(&read_urdf) read;
};

/// Another format is a line here.
const std::vector<Format> formats = {
    {"URDF", {".urdf", ".xacro"}, "<robot", read_urdf},
};

const Format* format_of_name(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Format& format : formats)
    if (std::ranges::count(format.extensions, extension) > 0) return &format;
  return nullptr;
}

const Format* format_of_text(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || text[begin] != '<') return nullptr;
  for (const Format& format : formats)
    if (text.find(format.element) != std::string_view::npos) return &format;
  return nullptr;
}

}  // namespace

std::optional<RobotDescription> read_robot(const std::filesystem::path& path,
                                           const PackagePaths& packages, Diagnostics& diagnostics) {
  const Format* format = format_of_name(path);
  try {
    if (format == nullptr) format = format_of_text(io::read_text_file(path));
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return {};
  }
  if (format != nullptr) return format->read(path, packages, diagnostics);
  diagnostics.error({path.string()},
                    "kind of robot file is unknown, expected one of: " + robot_formats());
  return {};
}

bool is_robot_name(const std::filesystem::path& path) {
  return format_of_name(path) != nullptr;
}

bool is_robot_text(std::string_view text) {
  return format_of_text(text) != nullptr;
}

std::string robot_formats() {
  std::string list;
  for (const Format& format : formats) {
    list += (list.empty() ? "" : ", ") + format.name + " (";
    for (const std::string& extension : format.extensions)
      list += (list.back() == '(' ? "" : ", ") + extension;
    list += ")";
  }
  return list;
}

}  // namespace pedicel::robot
