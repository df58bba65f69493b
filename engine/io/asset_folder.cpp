#include "pedicel/io/asset_folder.h"

#include <dlfcn.h>

namespace pedicel::io {

namespace {

// The file that this code lies in: the program, or a module that another program has loaded.
std::filesystem::path file_of_this_code() {
  Dl_info info;
  if (!dladdr(reinterpret_cast<const void*>(&asset_folder_of), &info) || !info.dli_fname) return {};
  std::error_code none;
  return std::filesystem::canonical(info.dli_fname, none);
}

}  // namespace

std::filesystem::path asset_folder() {
  std::error_code none;
  // Of a program that was found on the path, dladdr() knows the name only.
  const auto by_program = asset_folder_of(std::filesystem::read_symlink("/proc/self/exe", none));
  return by_program.empty() ? asset_folder_of(file_of_this_code()) : by_program;
}

std::filesystem::path asset_folder_of(const std::filesystem::path& program) {
  std::error_code none;
  for (auto folder = program.parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    for (const char* place : {"assets", "share/pedicel/assets"})
      if (std::filesystem::is_directory(folder / place / "leaves", none)) return folder / place;
  return {};
}

std::string shipped_file(const std::string& name, const std::filesystem::path& assets) {
  std::error_code none;
  const std::filesystem::path path = name;
  const bool named = path.is_relative() && path.has_parent_path();
  if (!named || assets.empty() || std::filesystem::exists(path, none)) return name;
  const std::filesystem::path shipped = assets.parent_path() / path;
  return std::filesystem::is_regular_file(shipped, none) ? shipped.string() : name;
}

std::string shipped_file(const std::string& name) {
  return shipped_file(name, asset_folder());
}

}  // namespace pedicel::io
