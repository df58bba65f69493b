#include "engine/geometry/cache_folder.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

namespace pedicel::geometry {

namespace fs = std::filesystem;

namespace {

struct Entry {
  fs::path path;
  std::uintmax_t bytes = 0;
  fs::file_time_type used;
};

bool is_part(const fs::path& path) {
  return path.filename().string().find(".sdf.part") != std::string::npos;
}

/// The cache's own files, those used longest ago first.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code error, gone;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const fs::path& path = at->path();
    if (path.extension() != ".sdf" && !is_part(path)) continue;
    Entry entry{path, fs::file_size(path, gone), {}};
    if (gone) continue;
    entry.used = fs::last_write_time(path, gone);
    if (!gone) entries.push_back(std::move(entry));
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.used != b.used ? a.used < b.used : a.path < b.path;
  });
  return entries;
}

}  // namespace

fs::path default_cache_folder() {
  if (const char* own = std::getenv("PEDICEL_CACHE"); own && own[0] != '\0')
    return std::string(own) == "off" ? fs::path{} : fs::path(own);
  // XDG Base Directory specification: a relative path is ignored.
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && cache[0] == '/')
    return fs::path(cache) / "pedicel";
  if (const char* home = std::getenv("HOME"); home && home[0] != '\0')
    return fs::path(home) / ".cache" / "pedicel";
  return {};
}

void mark_used(const fs::path& file) {
  std::error_code ignored;  // a cache that cannot be written can still be read
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
}

std::uintmax_t trim_cache(const fs::path& folder, std::uintmax_t bound, const fs::path& keep) {
  const std::vector<Entry> entries = entries_of(folder);
  std::uintmax_t bytes = 0;
  for (const Entry& entry : entries) bytes += entry.bytes;
  const auto an_hour_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const Entry& entry : entries) {
    const bool abandoned = is_part(entry.path) && entry.used < an_hour_ago;
    const bool surplus = bytes > bound && !is_part(entry.path) && entry.path != keep;
    std::error_code ignored;
    if (!abandoned && !surplus) continue;
    fs::remove(entry.path, ignored);
    bytes -= entry.bytes;
  }
  return bytes;
}

}  // namespace pedicel::geometry
