#include "pedicel/io/asset_folder.h"

namespace pedicel::io {

std::filesystem::path asset_folder() {
  std::error_code none;
  return asset_folder_of(std::filesystem::read_symlink("/proc/self/exe", none));
}

std::filesystem::path asset_folder_of(const std::filesystem::path& program) {
  std::error_code none;
  for (auto folder = program.parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    for (const char* place : {"assets", "share/pedicel/assets"})
      if (std::filesystem::is_directory(folder / place / "leaves", none)) return folder / place;
  return {};
}

}  // namespace pedicel::io
