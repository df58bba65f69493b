#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/geometry/grid_distance.h"

namespace pedicel::geometry {

/// A grid as a file: magic, key, 10 numbers, 3 counts, samples, and a checksum of all before. Read
/// and written without a second copy in memory. Byte order is the machine's.
class GridFile {
 public:
  /// Writes beside and renames. Returns whether the file is in place; half of one never is.
  static bool write(const std::filesystem::path& path, const GridDistance& grid, std::uint64_t key);

  /// Nothing where the file is not a whole one with this key. What a damaged file says of its size
  /// is compared with the file before memory is taken.
  static std::optional<GridDistance> read(const std::filesystem::path& path, std::uint64_t key);
};

}  // namespace pedicel::geometry
