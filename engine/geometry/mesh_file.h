#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pedicel::geometry {

/// What is said of a file that Git LFS keeps elsewhere.
inline constexpr const char* lfs_advice = "a Git LFS pointer: run git lfs pull";

/// Whether a file is the few lines that Git LFS leaves in place of a file that was not fetched.
bool is_lfs_pointer(const std::filesystem::path& path);
/// The same of its text.
bool is_lfs_pointer(const std::string& text);

/// Why a file is no whole mesh, in words that say more than a parser's: a Git LFS pointer, an empty
/// file, a web page, an STL that is cut off or whose count of triangles is wrong. Nothing where
/// none of these is the case.
std::optional<std::string> mesh_file_fault(const std::filesystem::path& path);

}  // namespace pedicel::geometry
