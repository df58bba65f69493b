#pragma once

#include <filesystem>
#include <string>

#include "app/session/document/document.h"

namespace pedicel::app {

/// A scene file's text with what the document says otherwise: settings (dt, rods.KEY, coupling.KEY,
/// overrides of plants as `set:`), plants and where they stand, robot, bodies, ground, cameras,
/// recorded waypoints (`robot: recorded:`). Everything else, comments and layout too, stays as it
/// is. Plants that another program added stay, too. Paths are as seen from the scene's folder.
/// `text` is what `of` says, and `known` what it said when the document was read from it or last
/// written; the result is for `to`, another file maybe. Throws UsageError where the text cannot
/// hold a change, InvalidFile where a text is no scene.
std::string changed_scene_text(const Document& document, const std::string& text,
                               const std::string& known, const std::filesystem::path& of,
                               const std::filesystem::path& to);

/// The document as a new scene file. Its plants have files, or no stems.
std::string new_scene_text(const Document& document, const std::filesystem::path& to);

/// Whether two texts of a scene file say the same; false for one that is no scene.
bool is_same_scene(const std::string& a, const std::string& b, const std::filesystem::path& path);

}  // namespace pedicel::app
