#pragma once

#include <string>

#include "plugins/plant/plant_file.h"

namespace pedicel::app {

/// A plant file's text, changed where the plant says otherwise: comments, anchors and layout of all
/// else stay. Where that cannot be done (`keeps` becomes false) the plant as a whole, without
/// comments; so also where `text` is no plant file.
std::string changed_plant_text(const std::string& text, const plant::PlantFile& plant, bool& keeps);

}  // namespace pedicel::app
