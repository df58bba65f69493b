#include "geometry/grid_cache.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/state_hash.h"

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

std::uint64_t checksum(const char* bytes, std::size_t count) {
  StateHash hash;
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i, 8);
    hash.add(word);
  }
  for (; i < count; ++i) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])));
  return hash.value();
}

template <class T>
void append(std::string& bytes, const T* data, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}

std::optional<std::string> read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return std::move(bytes).str();
}

/// Returns whether the file is in place.
bool write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  static std::atomic<unsigned> count{0};  // two threads may build the same grid
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  const std::filesystem::path part =
      path.string() + ".part" + std::to_string(::getpid()) + "_" + std::to_string(count++);
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) std::filesystem::rename(part, path, error);
  if (file && !error) return true;
  std::filesystem::remove(part, error);
  return false;
}

}  // namespace

/// The layout of a cache file: magic, key, 10 numbers, 3 counts, samples, checksum of all before.
class GridFile {
 public:
  static std::string encode(const GridDistance& grid, std::uint64_t key) {
    std::string bytes(kMagic, sizeof kMagic);
    append(bytes, &key, 1);
    append(bytes, grid.mesh_box_.min().data(), 3);
    append(bytes, grid.mesh_box_.max().data(), 3);
    append(bytes, grid.origin_.data(), 3);
    append(bytes, &grid.spacing_, 1);
    append(bytes, grid.nodes_.data(), 3);
    append(bytes, grid.samples_.data(), grid.samples_.size());
    const std::uint64_t sum = checksum(bytes.data(), bytes.size());
    append(bytes, &sum, 1);
    return bytes;
  }

  /// Nothing where the bytes are not a whole file with this key.
  static std::optional<GridDistance> decode(const std::string& bytes, std::uint64_t key) {
    constexpr std::size_t kHeader =
        sizeof kMagic + sizeof key + 10 * sizeof(double) + 3 * sizeof(int);
    std::uint64_t sum = 0, found_key = 0;
    if (bytes.size() < kHeader + sizeof sum) return std::nullopt;
    const std::size_t end = bytes.size() - sizeof sum;
    std::memcpy(&sum, bytes.data() + end, sizeof sum);
    if (sum != checksum(bytes.data(), end)) return std::nullopt;
    if (std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0) return std::nullopt;
    const char* next = bytes.data() + sizeof kMagic;
    const auto take = [&next](auto* to, std::size_t count) {
      std::memcpy(to, next, count * sizeof *to);
      next += count * sizeof *to;
    };
    take(&found_key, 1);
    if (found_key != key) return std::nullopt;
    GridDistance grid;
    take(grid.mesh_box_.min().data(), 3);
    take(grid.mesh_box_.max().data(), 3);
    take(grid.origin_.data(), 3);
    take(&grid.spacing_, 1);
    take(grid.nodes_.data(), 3);
    const std::size_t samples = (end - kHeader) / sizeof(float);
    if (grid.nodes_.cast<double>().prod() != static_cast<double>(samples)) return std::nullopt;
    grid.samples_.resize(samples);
    take(grid.samples_.data(), samples);
    return grid;
  }

 private:
  static constexpr char kMagic[8] = {'P', 'E', 'D', 'I', 'S', 'D', 'F', '1'};
};

std::filesystem::path default_cache_folder() {
  // XDG Base Directory specification: a relative path is ignored.
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && cache[0] == '/')
    return std::filesystem::path(cache) / "pedicel";
  if (const char* home = std::getenv("HOME"); home && home[0] != '\0')
    return std::filesystem::path(home) / ".cache" / "pedicel";
  return {};
}

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
  if (const std::optional<std::string> bytes = read_bytes(path)) {
    if (std::optional<GridDistance> grid = GridFile::decode(*bytes, key)) {
      result.from_cache = true;
      return *std::move(grid);
    }
    result.problem = path.string() + ": damaged cache file, built anew";
  }
  GridDistance grid(MeshDistance(mesh), settings, pool);
  if (!write_bytes(path, GridFile::encode(grid, key)))
    result.problem = path.string() + ": cannot be written, distances will be computed again";
  return grid;
}

}  // namespace pedicel::geometry
