#pragma once

#include <string>

#include "plugins/discrepancy/log_import/log_contents.h"
#include "plugins/discrepancy/log_import/log_scene.h"

namespace pedicel::discrepancy {

/// A first map of a log, from the topics and types found and the names of the scene: what is
/// certain as it stands, what is not in comments. `scene`: as the map is to say it.
std::string proposed_map(const LogContents& log, const LogScene& scene,
                         const std::filesystem::path& scene_path);

}  // namespace pedicel::discrepancy
