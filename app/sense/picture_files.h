#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/sense/sensed_picture.h"
#include "engine/world/sensors.h"

namespace pedicel::app {

using Json = nlohmann::ordered_json;

/// {"width", "height", "fx", "fy", "cx", "cy", "intrinsic", "extrinsic" (world to camera),
/// "position", "orientation"}: conventions as CameraMatrices has them.
Json camera_json(const CameraMatrices& camera);

/// What labels mean: a list of {"id", "name", "class", "class_id", "plant"}, by id.
Json things_json(const NamedThings& things);

/// Keypoints that are in the picture or hidden: {"id", "name", "x", "y", "depth_m", "v"}.
Json keypoints_json(const SensedPicture& picture, const NamedThings& things);

/// Depths as numpy's file: float32, (height, width), m; infinite where nothing is, nan where it was
/// lost.
std::string depth_npy(const render::LabelMap& map);

/// What a sensor's file is called: "rgb.png", "depth.png", "instances.png", ...
std::string file_end_of(world::Sensor sensor);

/// Writes what is wanted of a picture as FOLDER/NAME.rgb.png and so on; beside a depth.png there is
/// a depth.npy, and always a NAME.json with time, camera and keypoints. Returns the files. Throws
/// render::OutputError and io::WriteError.
std::vector<std::filesystem::path> write_sensors(const std::filesystem::path& folder,
                                                 const std::string& name,
                                                 const SensedPicture& picture,
                                                 const NamedThings& things,
                                                 const std::vector<world::Sensor>& wanted);

}  // namespace pedicel::app
