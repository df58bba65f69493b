#include "engine/urdf/file_in_other_case.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace pedicel::robot {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The entries of a folder whose names differ from `name` in case at most.
std::vector<fs::path> entries_like(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> found;
  const std::string wanted = lower(name);
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (lower(at->path().filename().string()) == wanted) found.push_back(at->path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::optional<fs::path> file_in_other_case(const fs::path& path) {
  const fs::path wanted = fs::absolute(path).lexically_normal();
  std::vector<fs::path> reached = {wanted.root_path()};
  std::error_code error;
  for (const fs::path& part : wanted.relative_path()) {
    std::vector<fs::path> next;
    for (const fs::path& folder : reached) {
      // A folder that is there as written is meant: another program would go into it, too.
      if (fs::exists(folder / part, error))
        next.push_back(folder / part);
      else
        for (fs::path& entry : entries_like(folder, part.string()))
          next.push_back(std::move(entry));
    }
    reached = std::move(next);
  }
  std::erase_if(reached, [&](const fs::path& p) { return !fs::is_regular_file(p, error); });
  if (reached.size() != 1) return std::nullopt;
  return reached.front();
}

}  // namespace pedicel::robot
