#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/geometry/cache_folder.h"
#include "engine/geometry/grid_distance.h"

namespace pedicel::geometry {

struct GridReport {
  bool from_cache = false;
  std::string problem;  ///< a damaged or unwritable cache file, in one sentence; else empty
};

/// The grid of a mesh, read from `folder` where it was built before. The file's name is a hash of
/// the mesh's content (scale included, since load_mesh applies it) and the settings. A damaged file
/// is found by its checksum and built anew; a folder that cannot be written costs time only, never
/// the result. Files are written beside and renamed, so several processes may share a folder; they
/// are for the machine that wrote them (byte order). After a new file the folder is brought below
/// cache_bound, the files that were used longest ago first. An empty folder means no cache.
GridDistance cached_grid(const TriangleMesh& mesh, const GridSettings& settings,
                         const std::filesystem::path& folder = default_cache_folder(),
                         ThreadPool* pool = nullptr, GridReport* report = nullptr);

/// The file that cached_grid uses.
std::filesystem::path grid_cache_file(const TriangleMesh& mesh, const GridSettings& settings,
                                      const std::filesystem::path& folder);

}  // namespace pedicel::geometry
