#pragma once

#include <string>

#include "session/document.h"

namespace pedicel::app {

/// A scene file's text with what the document says otherwise: settings (dt, rods.KEY, coupling.KEY,
/// overrides of plants as `set:`), where plants stand, which files they come from, plants that were
/// added or taken away, recorded waypoints (`robot: recorded:`). Everything else, comments and
/// layout too, stays as it is. Plants that the text names and the document never had stay, too.
/// Paths are written as seen from the scene's folder. Throws UsageError where the text cannot hold
/// a change, InvalidFile where the text is no scene.
std::string changed_scene_text(const Document& document, const std::string& text);

}  // namespace pedicel::app
