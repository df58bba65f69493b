#include "engine/core/files_read.h"

#include <atomic>
#include <mutex>
#include <set>

#include "engine/core/check.h"

namespace pedicel {

namespace {

std::atomic<bool> is_noted{false};
std::mutex noted_mutex;
std::set<std::filesystem::path> noted;

}  // namespace

FilesRead::FilesRead() {
  PEDICEL_ASSERT(!is_noted.exchange(true));
}

FilesRead::~FilesRead() {
  is_noted = false;
  const std::lock_guard lock(noted_mutex);
  noted.clear();
}

std::vector<std::filesystem::path> FilesRead::files() const {
  const std::lock_guard lock(noted_mutex);
  return {noted.begin(), noted.end()};
}

void note_file_read(const std::filesystem::path& path) {
  if (!is_noted) return;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(path, error);
  const std::lock_guard lock(noted_mutex);
  noted.insert(error ? path : whole);
}

}  // namespace pedicel
