#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pedicel::io {

/// Whether a file could be written there, so that what is written at the end of a long run is
/// refused at its beginning. Leaves everything as it is. Throws WriteError with the path and the
/// reason: no such place, a folder, a device, a full or read-only disk, a file that another run is
/// writing.
void check_output_file(const std::filesystem::path& path);

/// Whether files could be made in a folder that is there, or could be made itself.
void check_place_for_files(const std::filesystem::path& folder);

/// All of that for a folder that an OutputFolder or write_folder() is going to take: that no other
/// run is writing there, and that none of `names` is somebody else's.
void check_output_folder(const std::filesystem::path& folder,
                         const std::vector<std::string>& names = {});

/// A folder that one writer has for itself as long as this lives; nothing is written for it. Throws
/// WriteError where another one has it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

/// "another run is writing there, expected another name"
extern const char* const other_run_writes;

}  // namespace pedicel::io
