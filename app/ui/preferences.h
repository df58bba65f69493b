#pragma once

#include <filesystem>
#include <string>

namespace pedicel::app {

enum class Theme { dark, light };
enum class MousePreset { gazebo, blender };

/// What is remembered from one start to the next.
struct Preferences {
  Theme theme = Theme::dark;
  MousePreset mouse = MousePreset::gazebo;
  double font_scale = 1.0;         ///< 1, 0.7 .. 2
  double orbit_sensitivity = 1.0;  ///< 1, 0.2 .. 3
  bool invert_orbit = false;       ///< up and down
  bool invert_wheel = false;
  bool show_left = true, show_right = true, show_bottom = false;
  double left_width = 276.0, right_width = 304.0, bottom_height = 212.0;  ///< px at scale 1
  double pull_stiffness = 50.0;  ///< N/m, of the spring of Ctrl+drag
  bool degrees = true;           ///< joint angles are shown in degrees
  bool seen_hint = false;        ///< the hint of the first start was closed

  bool operator==(const Preferences&) const = default;
};

/// Where they are kept: $XDG_CONFIG_HOME/pedicel/desktop.yaml, or ~/.config/...; empty where there
/// is no home.
std::filesystem::path preferences_path();
/// What the file says; defaults for what it does not say or says wrongly.
Preferences read_preferences(const std::filesystem::path& path);
/// Atomically. Returns why it could not, empty where it could.
std::string write_preferences(const Preferences& preferences, const std::filesystem::path& path);

}  // namespace pedicel::app
