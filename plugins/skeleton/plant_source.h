#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::plant {

/// What a file that a plant can be read from is.
enum class SourceKind { unknown, plant_file, skeleton_table, mtg, ply_skeleton, helios_xml };

/// By the name: *.yaml, *.yml; *.csv, *.tsv, *.txt; *.mtg; *.ply; *.xml. In any case.
SourceKind source_kind(const std::filesystem::path& path);

/// Whether a file that can be read begins as a skeleton table does, whatever its name.
bool is_skeleton_table(const std::filesystem::path& path);

/// Whether a file's kind is one of digitised or grown plants of other programs.
bool is_skeleton(SourceKind kind);

/// Reads a plant file, a skeleton or cylinder table, an MTG, a skeleton as PLY or a plant structure
/// of Helios. `unit` (m, see io::length_unit()): of the lengths in it; 0: as the file says, else m,
/// or mm in an MTG. A plant file is in m and takes none. Faults, columns that are not read and
/// sizes that no plant has go to `diagnostics`, and for skeletons the height (a notice); nothing
/// comes back after an error. `kind` where the name does not tell it.
std::optional<PlantFile> read_plant_source(const std::filesystem::path& path, double unit,
                                           Diagnostics& diagnostics,
                                           SourceKind kind = SourceKind::unknown);

}  // namespace pedicel::plant
