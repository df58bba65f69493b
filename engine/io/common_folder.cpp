#include "engine/io/common_folder.h"

namespace pedicel::io {

std::filesystem::path common_folder(std::span<const std::filesystem::path> files) {
  std::filesystem::path folder = files.front().parent_path();
  for (const std::filesystem::path& file : files) {
    while (true) {
      const std::filesystem::path beside = file.lexically_relative(folder);
      if (!beside.empty() && *beside.begin() != "..") break;
      folder = folder.parent_path();
    }
  }
  return folder;
}

}  // namespace pedicel::io
