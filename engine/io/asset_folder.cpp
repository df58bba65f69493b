#include "pedicel/io/asset_folder.h"

namespace pedicel::io {

std::filesystem::path asset_folder() {
  std::error_code none;
  for (auto folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
       folder.has_relative_path(); folder = folder.parent_path())
    if (std::filesystem::is_directory(folder / "assets" / "leaves", none)) return folder / "assets";
  return {};
}

}  // namespace pedicel::io
