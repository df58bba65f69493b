#pragma once

#include <filesystem>
#include <vector>

namespace pedicel {

/// While there is one, every file that a reader opens is put on its list: scenes, plants, meshes,
/// tables, and not the caches. One at a time; from any thread.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// Absolute, sorted, each once. What is no file (a pipe) is not among them.
  std::vector<std::filesystem::path> files() const;
};

/// To be called by whatever opens an input.
void note_file_read(const std::filesystem::path& path);

}  // namespace pedicel
