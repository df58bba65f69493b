#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/diagnostics.h"
#include "plugins/plant/model/plant_model.h"

namespace pedicel::plant {

/// Where the leaf templates of a plant in `folder` are looked for.
SearchPath leaf_folders_of(const std::filesystem::path& folder);

/// Reads a plant file. Every fault goes to `diagnostics` with its line and column; nothing comes
/// back where there is one. A file that cannot be read or is no YAML is such a fault, too.
std::optional<PlantFile> read_plant_file(const std::filesystem::path& path,
                                         Diagnostics& diagnostics);

/// The same from text; `name` stands for the file in errors.
std::optional<PlantFile> parse_plant(const std::string& text, const std::string& name,
                                     Diagnostics& diagnostics);

/// What the reader checks once everything is read, for plants made in other ways, too: names that
/// are unknown or used twice, too few or equal points, radius lists of the wrong length, incomplete
/// materials, a root that no curve end is near to. False after an error.
bool check_plant(const PlantFile& plant, Diagnostics& diagnostics);

/// The plant as a file: keys in the order of the format, numbers exact, so that
/// parse_plant(plant_text(x)) == x.
std::string plant_text(const PlantFile& plant);

/// One entry of an `effects:` list, {name: ..., ...}.
std::string effect_text(const Effect& effect);

/// A text as YAML reads it back: plain where nothing in it has a meaning there, else quoted.
std::string yaml_word(const std::string& text);

/// Writes it in one piece. Throws io::WriteError.
void write_plant_file(const std::filesystem::path& path, const PlantFile& plant);

}  // namespace pedicel::plant
