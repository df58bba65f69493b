#include "engine/io/asset_folder.h"

#include <dlfcn.h>
#include <sys/auxv.h>

namespace pedicel::io {

namespace {

// The module that this code lies in, where another program has loaded it; nothing where it lies in
// the program itself, of which dladdr() knows no more than the name by which it was called.
std::filesystem::path module_of_this_code() {
  Dl_info here, program;
  if (!dladdr(reinterpret_cast<const void*>(&asset_folder_of), &here) || !here.dli_fname) return {};
  // The kernel tells where the program's own headers lie.
  if (dladdr(reinterpret_cast<const void*>(getauxval(AT_PHDR)), &program) &&
      program.dli_fbase == here.dli_fbase)
    return {};
  std::error_code none;
  return std::filesystem::canonical(here.dli_fname, none);
}

}  // namespace

std::filesystem::path asset_folder() {
  std::error_code none;
  // A module's own come first: beside Python there may be those of another version.
  const auto by_module = asset_folder_of(module_of_this_code());
  return by_module.empty() ? asset_folder_of(std::filesystem::read_symlink("/proc/self/exe", none))
                           : by_module;
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
  const bool is_there = std::filesystem::is_regular_file(shipped, none) ||
                        std::filesystem::is_regular_file(shipped / "experiment.yaml", none);
  return is_there ? shipped.string() : name;
}

std::string shipped_file(const std::string& name) {
  return shipped_file(name, asset_folder());
}

}  // namespace pedicel::io
