#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pedicel::io {

/// What an option writes into a file of its own.
enum class OutputKind { log, events, state, mcap, hdf5, gltf, picture, film, page };

/// As check_output_file(), and what is there may only be an earlier output of that kind, or an
/// empty file: nobody's scene, plant or table is replaced. Nor is a file that the list of a folder
/// names as a run's (see OutputFolder), except in `own`, the folder that this run writes. Throws
/// WriteError, which says what was expected.
void check_output_file(const std::filesystem::path& path, OutputKind kind,
                       const std::filesystem::path& own = {});

/// Whether the hidden list of a folder says that a run wrote that file there.
bool is_file_of_a_run(const std::filesystem::path& folder, const std::string& name);

/// Of a name's end: ".mcap", ".h5", ".glb", ".png", ".mp4", ".html"; `otherwise` of every other.
OutputKind kind_of_name(std::string_view name, OutputKind otherwise);

}  // namespace pedicel::io
