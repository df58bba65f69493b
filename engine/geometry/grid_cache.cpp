#include "engine/geometry/grid_cache.h"

#include <cstdio>

#include "engine/core/state_hash.h"
#include "engine/geometry/grid_file.h"

namespace pedicel::geometry {

namespace {

/// Raise it when the samples or the layout change: older files are then not found any more.
constexpr std::uint64_t kVersion = 1;

std::uint64_t content_key(const TriangleMesh& mesh, const GridSettings& settings) {
  StateHash hash;
  hash.add(kVersion);
  hash.add(settings.max_error);
  hash.add(settings.band);
  hash.add(std::uint64_t{mesh.vertices.size()});
  for (const Vec3& vertex : mesh.vertices) hash.add(vertex);
  for (const auto& triangle : mesh.triangles)
    for (const int vertex : triangle) hash.add(static_cast<std::uint64_t>(vertex));
  return hash.value();
}

}  // namespace

std::filesystem::path grid_cache_file(const TriangleMesh& mesh, const GridSettings& settings,
                                      const std::filesystem::path& folder) {
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.sdf",
                static_cast<unsigned long long>(content_key(mesh, settings)));
  return folder / name;
}

GridDistance cached_grid(const TriangleMesh& mesh, const GridSettings& settings,
                         const std::filesystem::path& folder, ThreadPool* pool,
                         GridReport* report) {
  GridReport unused;
  GridReport& result = report ? *report : unused;
  result = {};
  if (folder.empty()) return GridDistance(MeshDistance(mesh), settings, pool);

  const std::uint64_t key = content_key(mesh, settings);
  const std::filesystem::path path = grid_cache_file(mesh, settings, folder);
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    if (std::optional<GridDistance> grid = GridFile::read(path, key)) {
      result.from_cache = true;
      mark_used(path);
      return *std::move(grid);
    }
    // Another program may have removed it meanwhile, to make room.
    if (std::filesystem::exists(path, error))
      result.problem = path.string() + ": damaged cache file, built anew";
  }
  GridDistance grid(MeshDistance(mesh), settings, pool);
  if (GridFile::write(path, grid, key))
    trim_cache(folder, cache_bound, path);
  else
    result.problem = path.string() + ": cannot be written, distances will be computed again";
  return grid;
}

}  // namespace pedicel::geometry
