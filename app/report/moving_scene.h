#pragma once

#include <filesystem>
#include <optional>

#include "engine/io/html_report.h"

namespace pedicel::app {

/// The script that plays moving scenes in a page (model-viewer, UMD): what PEDICEL_VIEWER names,
/// else viewer/model-viewer.js of the assets, else what tools/viewer has fetched. Nothing where
/// there is none.
std::optional<std::filesystem::path> viewer_script();

/// Adds a moving scene (GLB) to a page, or, where it cannot be played there, a sentence that says
/// where it lies and why.
void add_moving_scene(io::HtmlReport& page, const std::filesystem::path& glb);

}  // namespace pedicel::app
