#include "app/ui/preferences.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdlib>

#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

struct Writer {
  YAML::Emitter& out;
  void operator()(const char* key, double& value, double, double) {
    out << YAML::Key << key << YAML::Value << value;
  }
  void operator()(const char* key, bool& value) { out << YAML::Key << key << YAML::Value << value; }
};

struct Reader {
  const YAML::Node& in;
  void operator()(const char* key, double& value, double low, double high) {
    if (const YAML::Node node = in[key]) value = std::clamp(node.as<double>(value), low, high);
  }
  void operator()(const char* key, bool& value) {
    if (const YAML::Node node = in[key]) value = node.as<bool>(value);
  }
};

/// Every field once, for reading and for writing.
template <class Visitor>
void visit(Preferences& p, Visitor&& field) {
  bool light = p.theme == Theme::light, blender = p.mouse == MousePreset::blender;
  field("light_theme", light);
  field("blender_mouse", blender);
  p.theme = light ? Theme::light : Theme::dark;
  p.mouse = blender ? MousePreset::blender : MousePreset::gazebo;
  field("font_scale", p.font_scale, 0.7, 2.0);
  field("orbit_sensitivity", p.orbit_sensitivity, 0.2, 3.0);
  field("invert_orbit", p.invert_orbit);
  field("invert_wheel", p.invert_wheel);
  field("show_left", p.show_left);
  field("show_right", p.show_right);
  field("show_bottom", p.show_bottom);
  field("left_width", p.left_width, 180.0, 600.0);
  field("right_width", p.right_width, 200.0, 600.0);
  field("bottom_height", p.bottom_height, 100.0, 600.0);
  field("pull_stiffness", p.pull_stiffness, 1.0, 1000.0);
  field("degrees", p.degrees);
  field("seen_hint", p.seen_hint);
}

}  // namespace

std::filesystem::path preferences_path() {
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config)
    return std::filesystem::path(config) / "pedicel" / "desktop.yaml";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".config" / "pedicel" / "desktop.yaml";
  return {};
}

Preferences read_preferences(const std::filesystem::path& path) {
  Preferences preferences;
  try {
    const YAML::Node file = YAML::LoadFile(path.string());
    if (file.IsMap()) visit(preferences, Reader{file});
  } catch (const YAML::Exception&) {
    // A missing or broken file of preferences must not keep anybody from working.
  }
  return preferences;
}

std::string write_preferences(const Preferences& preferences, const std::filesystem::path& path) {
  if (path.empty()) return {};
  YAML::Emitter out;
  out << YAML::BeginMap;
  Preferences copy = preferences;
  visit(copy, Writer{out});
  out << YAML::EndMap;
  try {
    std::filesystem::create_directories(path.parent_path());
    io::write_file_atomically(path, std::string(out.c_str()) + "\n");
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace pedicel::app
