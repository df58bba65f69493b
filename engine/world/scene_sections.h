#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/described_map.h"
#include "engine/world/scene.h"

/// The parts of the scene reader, one a section of the file (scene_reader.cpp calls them).
namespace pedicel::world::sections {

inline constexpr io::Bounds view_angles{0.01, 3.0};   ///< rad, a camera's field of view
inline constexpr io::Bounds picture_sizes{16, 8192};  ///< px, width or height

/// `size: [width, height]` within picture_sizes. As it was after an error.
void read_picture_size(io::DescribedMap& map, std::array<int, 2>& size);
/// Of that key, in a list of keys.
io::Key picture_size_key(const std::array<int, 2>& otherwise, const std::string& sentence);

/// How a section writes a path: relative to the scene file's folder. Reports a file that is absent,
/// unless `may_be_absent`.
std::filesystem::path read_path(const io::YamlNode& node, const std::string& what,
                                const std::filesystem::path& folder, bool may_be_absent = false);

/// A map of keys to scalars, kept as texts with their places.
std::vector<Setting> read_settings(const io::YamlNode& node, const std::string& what);

/// {fruit: NAME} | {body: NAME} | {plant: NAME} | {tool: true}
Anchor read_anchor(const io::YamlNode& node, const std::string& what);

/// A vector, whose coordinates must be within the described bounds.
Vec3 read_place(io::DescribedMap& map, const std::string& key);

/// Keys `position` and `orientation`, as pose_keys() describes them.
Pose read_pose(io::DescribedMap& map);

// The keys of each map of the file, beside the function that reads it; scene_keys() has them all.
const io::KeyList& pose_keys();
const io::KeyList& thing_keys();
std::vector<const io::KeyList*> plant_keys();
std::vector<const io::KeyList*> robot_keys();
std::vector<const io::KeyList*> body_keys();
std::vector<const io::KeyList*> sensor_keys();
std::vector<const io::KeyList*> view_keys();
std::vector<const io::KeyList*> expectation_keys();
}  // namespace pedicel::world::sections

namespace pedicel::world {
/// Of `vary`, and of a file that has nothing else.
std::vector<const io::KeyList*> variation_keys();
}  // namespace pedicel::world

namespace pedicel::world::sections {

ScenePlant read_plant(const io::YamlNode& node, const std::filesystem::path& folder);
SceneRobot read_robot(const io::YamlNode& node, const std::filesystem::path& folder);
BodyDescription read_body(const io::YamlNode& node);
GroundPlane read_ground(const io::YamlNode& node);
SceneWind read_wind(const io::YamlNode& node);
SceneLoad read_load(const io::YamlNode& node);
SceneTie read_tie(const io::YamlNode& node);
SceneCut read_cut(const io::YamlNode& node);
SceneCamera read_camera(const io::YamlNode& node);
SceneInstrument read_instrument(const io::YamlNode& node, const InstrumentKind& kind);
SceneLook read_look(const io::YamlNode& node);
ScenePicture read_picture(const io::YamlNode& node);
SceneVideo read_video(const io::YamlNode& node);
SceneSweep read_sweep(const io::YamlNode& node);
Expectation read_expectation(const io::YamlNode& node);

}  // namespace pedicel::world::sections
