#include "engine/geometry/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

namespace pedicel::geometry {

namespace {

constexpr std::uintmax_t stl_header = 84, stl_triangle = 50;  // bytes

/// The first or the last bytes of a file.
std::string bytes_of(const std::filesystem::path& path, std::size_t count, bool end = false) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  count = static_cast<std::size_t>(std::min<std::uintmax_t>(error ? 0 : size, count));
  if (end) file.seekg(-static_cast<std::streamoff>(count), std::ios::end);
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// "solid NAME" and, soon after it, a facet or the end; a binary header may begin with "solid",
/// too.
bool is_text_stl(const std::string& start) {
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || start.compare(first, 5, "solid") != 0) return false;
  return start.find("facet") != std::string::npos || start.find("endsolid") != std::string::npos;
}

std::optional<std::string> text_stl_fault(const std::filesystem::path& path) {
  const std::string tail = bytes_of(path, 4096, true);
  const std::size_t closed = tail.rfind("endfacet"), end = tail.rfind("endsolid");
  // "endfacet" holds a "facet" of its own.
  const std::size_t after = closed == std::string::npos ? 0 : closed + std::strlen("endfacet");
  if (end != std::string::npos || tail.find("facet", after) == std::string::npos) return {};
  return "cut off in the midst of a facet, expected endfacet and endsolid";
}

std::optional<std::string> binary_stl_fault(const std::string& start, std::uintmax_t size) {
  if (size < stl_header) return "cut off: " + std::to_string(size) + " bytes, expected at least 84";
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, start.data() + 80, sizeof triangles);
  const std::uintmax_t expected = stl_header + stl_triangle * triangles;
  if (size < expected)
    return "cut off: " + std::to_string(size) + " of " + std::to_string(expected) + " bytes (" +
           std::to_string(triangles) + " triangles)";
  if (size > expected)
    return "wrong count: " + std::to_string(triangles) + " triangles take " +
           std::to_string(expected) + " bytes, the file has " + std::to_string(size);
  if (triangles == 0) return "no triangles, expected at least one with an area";
  return {};
}

/// What is no mesh by its first bytes, though its name says so.
std::optional<std::string> other_kind(const std::string& start) {
  using namespace std::string_view_literals;
  for (const auto& [bytes, kind] :
       {std::pair{"PK\x03\x04"sv, "a zip archive"}, std::pair{"\x1F\x8B"sv, "compressed with gzip"},
        std::pair{"7z\xBC\xAF"sv, "a 7z archive"}, std::pair{"Rar!\x1A"sv, "a RAR archive"}})
    if (start.starts_with(bytes)) return std::string(kind) + ", expected a mesh: unpack it first";
  for (const auto& [bytes, kind] :
       {std::pair{"\x89PNG\r\n"sv, "a PNG image"}, std::pair{"\xFF\xD8\xFF"sv, "a JPEG image"},
        std::pair{"%PDF-"sv, "a PDF document"}, std::pair{"ISO-10303-21"sv, "a STEP model"},
        std::pair{"\xD0\xCF\x11\xE0"sv, "a document of a CAD or Office program"}})
    if (start.starts_with(bytes)) return std::string(kind) + ", expected a mesh: export one as STL";
  return {};
}

}  // namespace

bool is_lfs_pointer(const std::string& text) {
  return text.starts_with("version https://git-lfs");
}

bool is_lfs_pointer(const std::filesystem::path& path) {
  return is_lfs_pointer(bytes_of(path, 64));
}

std::optional<std::string> mesh_file_fault(const std::filesystem::path& path) {
  const std::string start = bytes_of(path, 1024);
  if (start.empty()) return "an empty file, expected a mesh";
  if (is_lfs_pointer(start)) return lfs_advice;
  const std::string first = lower(start);
  if (first.starts_with("<!doctype html") || first.starts_with("<html"))
    return "a web page, expected a mesh: fetch the raw file";
  if (const auto kind = other_kind(start)) return kind;
  if (lower(path.extension().string()) != ".stl") return {};
  if (is_text_stl(start)) return text_stl_fault(path);
  std::error_code error;
  return binary_stl_fault(start, std::filesystem::file_size(path, error));
}

}  // namespace pedicel::geometry
