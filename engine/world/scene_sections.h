#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/io/yaml.h"
#include "pedicel/world/scene.h"

/// The parts of the scene reader, one a section of the file (scene_reader.cpp calls them).
namespace pedicel::world::sections {

/// How a section writes a path: relative to the scene file's folder. Reports a file that is absent,
/// unless `may_be_absent`.
std::filesystem::path read_path(const io::YamlNode& node, const std::string& what,
                                const std::filesystem::path& folder, bool may_be_absent = false);

/// A map of keys to scalars, kept as texts with their places.
std::vector<Setting> read_settings(const io::YamlNode& node, const std::string& what);

/// {fruit: NAME} | {body: NAME} | {plant: NAME} | {tool: true}
Anchor read_anchor(const io::YamlNode& node, const std::string& what);

/// A place or an offset in m; every coordinate within io::place_bounds. Needed without `otherwise`.
Vec3 read_place(io::YamlMap& map, const std::string& key, std::optional<Vec3> otherwise = {});

/// Keys `position` and `orientation`.
Pose read_pose(io::YamlMap& map);

ScenePlant read_plant(const io::YamlNode& node, const std::filesystem::path& folder);
SceneRobot read_robot(const io::YamlNode& node, const std::filesystem::path& folder);
BodyDescription read_body(const io::YamlNode& node);
GroundPlane read_ground(const io::YamlNode& node);
SceneWind read_wind(const io::YamlNode& node);
SceneLoad read_load(const io::YamlNode& node);
SceneTie read_tie(const io::YamlNode& node);
SceneCut read_cut(const io::YamlNode& node);
SceneCamera read_camera(const io::YamlNode& node);
SceneWrench read_wrench(const io::YamlNode& node);
SceneLook read_look(const io::YamlNode& node);
ScenePicture read_picture(const io::YamlNode& node);
SceneVideo read_video(const io::YamlNode& node);
SceneSweep read_sweep(const io::YamlNode& node);
Expectation read_expectation(const io::YamlNode& node);

}  // namespace pedicel::world::sections
